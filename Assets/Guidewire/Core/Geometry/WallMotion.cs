using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>How a wall moves, by cycles such as the heart's and the breath's: as a rigid body, or with the points
    /// of its centreline. The wall's shape as it is given is that at rest.</summary>
    /// <remarks>The displacement grows from 0 within <see cref="RampTime"/>, so a run starts in the vessel at
    /// rest.</remarks>
    public sealed class WallMotion
    {
        /// <summary>Makes the motion.</summary>
        /// <param name="cycles">Rigid ones move what the others have displaced.</param>
        /// <param name="branches">Points of each branch of the centreline at rest, units, about as far apart as the
        /// spacing; none where all cycles are rigid.</param>
        /// <param name="spacing">Units; also the length over which the motion of neighbouring points is blended.
        /// </param>
        /// <param name="rampTime">s; 0: the wall is displaced from the start.</param>
        public WallMotion(IReadOnlyList<MotionCycle> cycles, IReadOnlyList<Vector3d[]> branches, double spacing,
            double rampTime)
        {
            (Cycles, Branches, Spacing, RampTime) = (cycles, branches, spacing, rampTime);
            Narrowest = FindNarrowest(cycles);
        }

        /// <summary>The cycles, in the order in which they act.</summary>
        public IReadOnlyList<MotionCycle> Cycles { get; }

        /// <summary>Points of the centreline at rest by branch, units.</summary>
        public IReadOnlyList<Vector3d[]> Branches { get; }

        /// <summary>Distance of neighbouring points, units.</summary>
        public double Spacing { get; }

        /// <summary>Time in which the displacement grows from 0, s.</summary>
        public double RampTime { get; }

        /// <summary>What pictures draw of one cycle, without the ramp: how far the points of its centreline are
        /// displaced at evenly spaced phases, in units, and the matrix, row by row, of what is beside a point, by which
        /// that is displaced more: 12 numbers a point. A rigid cycle has one point, the origin.</summary>
        public float[] Displacements(int cycle, int phases)
        {
            MotionCycle own = Cycles[cycle];
            var field = new WallField(new WallMotion(new[] { own }, PointsOf(cycle), Spacing, 0.0));
            var numbers = new List<float>();
            for (int k = 0; k < phases; k++)
            {
                field.SetTime(((double)k / phases - own.Phase) * own.Period);
                field.AddDisplacements(numbers);
            }
            return numbers.ToArray();
        }

        /// <summary>The points of the centreline that a cycle moves, by branch; none of a rigid one.</summary>
        public IReadOnlyList<Vector3d[]> PointsOf(int cycle) =>
            Cycles[cycle].IsRigid ? Array.Empty<Vector3d[]>() : Branches;

        /// <summary>The least scale of a section in a cycle, 1 or less.</summary>
        public double Narrowest { get; }

        /// <summary>The beam as which the vessel gives way before the cycles move it; null: it is rigid.</summary>
        public WallBeam? Beam { get; set; }

        /// <summary>Why no wire can be simulated in it, in one phrase, or null: somewhere near these points of the
        /// wall, at some phase, the field folds (its Jacobian is not positive).</summary>
        /// <param name="points">Units, at rest.</param>
        public string? FindFold(IReadOnlyList<Vector3d> points)
        {
            const int Phases = 24;
            if (Branches.Count == 0)
            {
                return null;
            }
            if (!(Narrowest > 0.0))
            {
                return "the motion closes the vessel: a scale of its sections comes to 0 or less";
            }
            var field = new WallField(this);
            double period = 0.0;    // of the one cycle that moves the centreline; rigid ones fold nothing
            foreach (MotionCycle cycle in Cycles)
            {
                period = cycle.IsRigid ? period : cycle.Period;
            }
            for (int k = 0; k < Phases; k++)
            {
                field.SetTime(RampTime + period * k / Phases);
                foreach (Vector3d point in points)
                {
                    if (!field.TryMove(point, out Vector3d moved) || !(field.DeterminantAt(moved) > 0.0))
                    {
                        return "the motion folds the vessel at " + point + ", " + (RampTime + period * k / Phases)
                            .ToString("G3", System.Globalization.CultureInfo.InvariantCulture)
                            + " s after the start (its Jacobian is not positive)";
                    }
                }
            }
            return null;
        }

        private static double FindNarrowest(IReadOnlyList<MotionCycle> cycles)
        {
            const int Phases = 24;
            double least = 1.0;
            foreach (MotionCycle cycle in cycles)
            {
                var values = new double[cycle.IsRigid ? 0 : cycle.Count];
                for (int k = 0; k < Phases && values.Length > 0; k++)
                {
                    cycle.Evaluate((double)k / Phases, values);
                    for (int at = WallField.PerPoint - 1; at < values.Length; at += WallField.PerPoint)
                    {
                        least = Math.Min(least, 1.0 + values[at]);
                    }
                }
            }
            return least;
        }
    }

    /// <summary>One cycle of a wall's motion.</summary>
    public sealed class MotionCycle
    {
        private readonly CubicSpline? _table;
        private readonly double[]? _sine;

        private MotionCycle(double period, double phase, CubicSpline? table, double[]? sine)
        {
            (Period, Phase, _table, _sine) = (period, phase, table, sine);
        }

        /// <summary>s.</summary>
        public double Period { get; }

        /// <summary>Where in the cycle a run starts, in cycles.</summary>
        public double Phase { get; }

        /// <summary>Whether all of the wall moves as one body.</summary>
        public bool IsRigid { get; private set; }

        /// <summary>The point about which a rigid wall turns, units.</summary>
        public Vector3d About { get; private set; }

        /// <summary>Numbers at each moment: of a rigid cycle a displacement in units and a rotation vector in radians;
        /// else for each point of the centreline a displacement, a rotation vector and a change of scale.</summary>
        public int Count { get; private set; }

        /// <summary>How far the meshes that it was fitted to are beside it, units, in the mean and at most; null: it
        /// was not.</summary>
        public (double Mean, double Largest)? Misfit { get; set; }

        /// <summary>A rigid motion by a sine: its values are the amplitudes times sin(2 pi phase).</summary>
        /// <param name="translation">Units.</param>
        /// <param name="rotation">Radians.</param>
        /// <param name="about">Units.</param>
        public static MotionCycle Sine(double period, double phase, in Vector3d translation, in Vector3d rotation,
            in Vector3d about)
        {
            return new MotionCycle(period, phase, null, new[]
            {
                translation.X, translation.Y, translation.Z, rotation.X, rotation.Y, rotation.Z,
            })
            { IsRigid = true, About = about, Count = 6 };
        }

        /// <summary>A motion by a table, of which one row is a moment: periodic cubic splines through the
        /// rows.</summary>
        /// <param name="phases">Increasing, within one cycle.</param>
        /// <param name="rows">See <see cref="Count"/>.</param>
        /// <param name="about">Of a rigid motion, units; null: the rows are those of the centreline's points.</param>
        public static MotionCycle Table(double period, double phase, double[] phases, double[][] rows, Vector3d? about)
        {
            return new MotionCycle(period, phase, new CubicSpline(phases, rows, 1.0), null)
            {
                IsRigid = about.HasValue,
                About = about ?? Vector3d.Zero,
                Count = rows[0].Length,
            };
        }

        /// <summary>Gives the cycle of these motions with another period, which begins at another phase.</summary>
        public MotionCycle At(double period, double phase) =>
            new MotionCycle(period, phase, _table, _sine)
            {
                IsRigid = IsRigid, About = About, Count = Count, Misfit = Misfit,
            };

        /// <summary>Sets the values at a phase.</summary>
        internal void Evaluate(double phase, double[] values)
        {
            if (_table != null)
            {
                _table.Evaluate(phase, values);
                return;
            }
            double sine = Math.Sin(2.0 * Math.PI * phase);
            for (int c = 0; c < values.Length; c++)
            {
                values[c] = sine * _sine![c];
            }
        }
    }
}
