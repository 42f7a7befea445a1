using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Displacements of soft walls at all instruments of a run.</summary>
    public static class SoftWallDisplacements
    {
        /// <summary>Those at the elements of the wire and then of each catheter, m; of none where all walls are rigid.
        /// </summary>
        public static IEnumerable<Vector3d[]> Of(Simulation run)
        {
            if (run.Contacts == null || run.Contacts.Displacements.Length == 0)
            {
                yield break;
            }
            yield return run.Contacts.Displacements;
            foreach (CoaxialRecord catheter in run.Catheters())
            {
                yield return catheter.WallDisplacements;
            }
        }

        /// <summary>Writes or restores them, and the forces of strands.</summary>
        internal static void Serialize(Simulation run, Snapshot snapshot)
        {
            foreach (Vector3d[] own in Of(run))
            {
                snapshot.Serialize(own);
            }
            snapshot.Serialize(run.Contacts?.StrandForces ?? Array.Empty<Vector3d>());
            foreach (CoaxialRecord catheter in run.Catheters())
            {
                snapshot.Serialize(catheter.StrandForces);
            }
        }
    }
}
