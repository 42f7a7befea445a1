using Guidewire.Core;
using Guidewire.Runtime;
using UnityEditor;
using UnityEngine;

namespace Guidewire.Editor
{
    /// <summary>Shows in the scene view, before Play, where a loop's wire starts, its sheath, its target and the open
    /// rims of its vessels, and while it runs the walls' forces.</summary>
    internal static class LoopGizmos
    {
        private const float ForceLength = 0.1f;    // of the wire, for the largest force

        [DrawGizmo(GizmoType.Selected | GizmoType.InSelectionHierarchy | GizmoType.NonSelected | GizmoType.Pickable)]
        private static void Draw(SimulationLoop loop, GizmoType type)
        {
            Gizmos.matrix = loop.transform.localToWorldMatrix;
            if (loop.State != null)
            {
                DrawForces(loop.State);
            }
            else if (!Application.isPlaying && StartCheck.Of(loop).Last.Parameters is SimulationParameters parameters)
            {
                DrawStart(parameters, StartCheck.Of(loop).Last.Target);
            }
        }

        // Not a gizmo: the view's own mesh, as Play would begin with it. No object is made while a picture is.
        [DrawGizmo(GizmoType.Selected | GizmoType.InSelectionHierarchy | GizmoType.NonSelected)]
        private static void ShowStart(WireView view, GizmoType type)
        {
            if (!Application.isPlaying)
            {
                EditorApplication.delayCall += () => ShowStart(view);
            }
        }

        private static void ShowStart(WireView view)
        {
            if (view && !Application.isPlaying && view.Loop is { } loop)
            {
                StartCheck.Found found = StartCheck.Of(loop).Last;
                bool isNew = view.Mesh == null;
                view.DrawStart(found.Start, found.Parameters);
                if (isNew && view.Mesh != null)
                {
                    SceneView.RepaintAll();
                }
            }
        }

        [DrawGizmo(GizmoType.Selected | GizmoType.InSelectionHierarchy)]
        private static void DrawRims(SceneVessel vessel, GizmoType type)
        {
            Gizmos.matrix = Matrix4x4.identity;
            Gizmos.color = new Color(0.2f, 0.8f, 1f);
            foreach (Transform rim in vessel.OpenRims)
            {
                if (rim)
                {
                    Gizmos.DrawWireSphere(rim.position, 0.01f * (rim.position - vessel.transform.position).magnitude);
                }
            }
        }

        private static void DrawStart(SimulationParameters parameters, Vector3d? target)
        {
            SceneParameters scene = parameters.Scene;
            var first = new Vector3(0f, 0f, (float)scene.GuidewireOffset);
            Vector3 tip = first + (float)scene.GuidewireLength * Vector3.forward;
            float size = 0.01f * (float)scene.GuidewireLength;
            Gizmos.color = new Color(0.9f, 0.9f, 0.9f);
            Gizmos.DrawLine(first, tip);
            Gizmos.DrawWireSphere(tip, size);
            if (scene.Sheath?.Exit is Vector3d exit)
            {
                Gizmos.color = new Color(1f, 0.6f, 0.2f);
                Gizmos.DrawLine(first, exit.ToUnity());
                Gizmos.DrawWireSphere(exit.ToUnity(), size);
            }
            if (target.HasValue)
            {
                Gizmos.color = new Color(0.3f, 1f, 0.4f);
                Gizmos.DrawWireSphere(target.Value.ToUnity(), size);
            }
        }

        private static void DrawForces(WireState state)
        {
            double largest = 0.0;
            foreach (Vector3d force in state.ContactForces)
            {
                largest = System.Math.Max(largest, force.Length);
            }
            Gizmos.color = new Color(1f, 0.85f, 0.1f);
            double scale = ForceLength * state.Rod.ElementCount * state.Rod.ElementLength / largest;
            for (int i = 0; i < state.ContactForces.Length && largest > 0.0; i++)
            {
                Vector3 from = state.Rod.Positions[i].ToUnity();
                Gizmos.DrawLine(from, from + (scale * state.ContactForces[i]).ToUnity());
            }
        }
    }
}
