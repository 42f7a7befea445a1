using Guidewire.Core;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>A wall that acts on a sphere of the wire.</summary>
    public readonly struct WireContact
    {
        internal WireContact(SimulationLoop loop, WireState state, int sphere)
        {
            Transform frame = loop.transform;
            Vector3d force = state.ContactForces[sphere];
            Sphere = sphere;
            Place = frame.TransformPoint(state.Rod.Positions[sphere].ToUnity());
            Force = frame.rotation * force.ToUnity();
            Wall = state.ContactWalls[sphere];
            int own = Wall - (loop.Parameters!.Scene.Walls.Length - loop.Vessels.Length);    // a scene's stand last
            Vessel = own >= 0 && own < loop.Vessels.Length ? loop.Vessels[own] : null;
            IsTouched = true;
        }

        /// <summary>Index of the sphere, 0 at the hub.</summary>
        public int Sphere { get; }

        /// <summary>Place of the sphere in the world.</summary>
        public Vector3 Place { get; }

        /// <summary>Force of the wall on the wire along the world's axes, N with a material.</summary>
        public Vector3 Force { get; }

        /// <summary>Index of the wall among those of the parameters.</summary>
        public int Wall { get; }

        /// <summary>The vessel of the scene that it belongs to; null for a wall of the parameters.</summary>
        public SceneVessel? Vessel { get; }

        internal bool IsTouched { get; }
    }
}
