using System;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Warns once when a vessel has moved in the frame of a loop's object: its wall stays where it was when
    /// the wire was built.</summary>
    internal sealed class PlaceWatch
    {
        private const float Tolerance = 1e-3f;    // units

        private Matrix4x4[] _places = Array.Empty<Matrix4x4>();
        private SceneVessel[] _vessels = Array.Empty<SceneVessel>();

        /// <summary>Takes the places that count from now on.</summary>
        public void Begin(SimulationLoop loop)
        {
            _vessels = loop.Vessels;
            _places = Array.ConvertAll(_vessels, vessel => vessel ? PlaceOf(loop, vessel) : Matrix4x4.identity);
        }

        /// <summary>Compares the places with those.</summary>
        public void Check(SimulationLoop loop)
        {
            for (int k = 0; k < _places.Length; k++)
            {
                if (_vessels[k] && IsOther(_places[k], PlaceOf(loop, _vessels[k])))
                {
                    Debug.LogWarning("guidewire: vessel " + _vessels[k].name + " or the wire's object " + loop.name
                        + " has moved; the wall stays where it was until Load is called", loop);
                    _places = Array.Empty<Matrix4x4>();
                }
            }
        }

        private static Matrix4x4 PlaceOf(SimulationLoop loop, SceneVessel vessel) =>
            loop.transform.worldToLocalMatrix * vessel.transform.localToWorldMatrix;

        private static bool IsOther(in Matrix4x4 a, in Matrix4x4 b)
        {
            bool isOther = false;
            foreach (Vector3 point in Probes)
            {
                float scale = 1f + a.MultiplyPoint3x4(point).magnitude;
                isOther |= (a.MultiplyPoint3x4(point) - b.MultiplyPoint3x4(point)).magnitude > Tolerance * scale;
            }
            return isOther;
        }

        private static readonly Vector3[] Probes = { Vector3.zero, Vector3.right, Vector3.up, Vector3.forward };
    }
}
