using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>The lowest natural frequencies and mode shapes of a wire with a material about its rest shape: K v =
    /// w^2 M v with K the second derivative of its energies and loads there and M its mass.</summary>
    /// <remarks>Inverse iteration on K^-1 M, each solution in O(n) by the factorisation that rest shapes and motions
    /// use; modes that are found are taken out, so that two of the same frequency are both found. The error of w^2 is
    /// that of Rayleigh's quotient, of second order in the shape's.</remarks>
    public sealed class ModalAnalysis
    {
        private const int MaxIterations = 2000;
        private const double Settled = 1e-13;  // relative change of w^2 in an iteration
        private const double Neutral = 1e-15;  // w^2, of the largest of an element along its axis: 0 to rounding
        private const double Still = 1e-6;     // shift over L times the turn, of a mode of twist alone

        private readonly BlockTridiagonal _system;
        private readonly RodMass _mass;
        private readonly double _length;       // L, m
        private readonly List<RodVector[]> _found = new List<RodVector[]>();
        private readonly List<RodVector[]> _foundTimesMass = new List<RodVector[]>();

        private ModalAnalysis(MaterialScene scene, RodTerms terms, string? failure, int count)
        {
            _system = new BlockTridiagonal(scene.Rod, scene.Supports);
            _mass = terms.Mass;
            _length = scene.Rod.TotalLength;
            Positions = Array.ConvertAll(scene.Shape.X, x => x / scene.Metres);
            Failure = failure;
            if (failure != null)
            {
                return;
            }
            var gradient = new RodVector[_system.VectorCount];
            // The rest shape is stable: a negative pivot is that of a neutral motion, whose sign is rounding's.
            _system.Factorise(terms.All, scene.Shape, gradient, new RodVector[_system.VectorCount], 0.0);
            double fastest = 0.0;
            for (int j = 0; j < scene.Rod.ElementCount; j++)
            {
                double l = scene.Rod.Length[j];
                fastest = Math.Max(fastest, 4.0 * scene.Rod.StretchStiffness[j] / (scene.Rod.LineDensity[j] * l * l));
            }
            var frequencies = new double[count];
            for (int m = 0; m < count; m++)
            {
                double square = Find(m);
                frequencies[m] = square > Neutral * fastest ? Math.Sqrt(square) / (2.0 * Math.PI) : 0.0;
            }
            Frequencies = frequencies;
            Shapes = _found.ConvertAll(Shift).ToArray();
        }

        /// <summary>Why there are no modes, in one line, or null.</summary>
        public string? Failure { get; }

        /// <summary>Positions of the n+1 nodes at rest, in units.</summary>
        public Vector3d[] Positions { get; }

        /// <summary>The natural frequencies, Hz, ascending; 0 of a motion that changes no energy, such as the turn of a
        /// buckled wire about its thrust.</summary>
        public double[] Frequencies { get; } = Array.Empty<double>();

        /// <summary>Of each mode the shift of the n+1 nodes, the largest of length 1; 0 where a straight wire only
        /// twists.</summary>
        public Vector3d[][] Shapes { get; } = Array.Empty<Vector3d[]>();

        /// <summary>The lowest modes of the wire of these parameters about its rest shape.</summary>
        /// <param name="parameters">Of a method for a material; at least one end is clamped.</param>
        /// <param name="count">How many, from 1 to 3 n.</param>
        /// <exception cref="ArgumentException">Parameters that do not go together, pbd, too many modes.</exception>
        public static ModalAnalysis Of(SimulationParameters parameters, int count)
        {
            SimulationParameters atRest = parameters.Copy();
            atRest.Scene.InitialState = InitialState.Equilibrium;
            ParameterConflict? conflict = ParameterConflict.Find(atRest);
            if (conflict != null && conflict.Key == "initialState")
            {
                throw new ArgumentException("proximalEnd or distalEnd needs to be \"clamped\": modes are vibrations "
                    + "about a rest shape, and this wire has no unique one");
            }
            if (conflict != null)
            {
                throw new ArgumentException(conflict.Key + " needs " + conflict.Needed);
            }
            if (!MethodTable.Of(parameters.Method.Solver).TakesMaterial)
            {
                throw new ArgumentException("solver needs to be one for a material: a pbd wire has no natural "
                    + "frequencies");
            }
            if (count < 1 || count > 3 * ElementLayout.Count(atRest))
            {
                throw new ArgumentException("the number of modes needs to be from 1 to three times that of elements");
            }
            var scene = new MaterialScene(atRest, new Scene(atRest));
            var terms = new RodTerms(scene.Rod, scene.Supports, atRest.Scene);
            if (!terms.HavePotential)
            {
                throw new ArgumentException(terms.Followers.Keys + " needs to be 0: a follower load has no "
                    + "potential");
            }
            string? failure = new RestShape(scene, terms, 1e-10, 10 * atRest.Method.MaxNewtonIterations,
                new SolverReport()).Find(scene.Shape);
            return new ModalAnalysis(scene, terms, failure, count);
        }

        /// <summary>Finds one more mode; returns w^2.</summary>
        private double Find(int number)
        {
            var v = new RodVector[_system.VectorCount];
            var random = new Random(number);
            for (int i = 0; i < _mass.Rotary.Length + 1; i++)
            {
                v[i].X1 = random.NextDouble();
                v[i].X2 = random.NextDouble();
                v[i].X3 = random.NextDouble();
                v[i].T1 = random.NextDouble() / _length;
                v[i].T2 = random.NextDouble() / _length;
                v[i].T3 = random.NextDouble() / _length;
            }
            _system.Project(v);
            double square = double.NaN;
            for (int k = 0; k < MaxIterations; k++)
            {
                RodVector[] next = TimesMass(v);
                _system.Project(next);
                RodVector[] load = (RodVector[])next.Clone();
                _system.Solve(next);
                // v^T M K^-1 M v over v^T M v is 1/w^2 from below; of K^-1 M v it is better by one order.
                double stiffness = RodVectors.Dot(next, load);
                for (int f = 0; f < _found.Count; f++)
                {
                    RodVectors.AddScaled(next, -RodVectors.Dot(next, _foundTimesMass[f]), _found[f]);
                }
                RodVector[] heavy = TimesMass(next);
                double mass = RodVectors.Dot(next, heavy);
                RodVectors.Scale(next, 1.0 / Math.Sqrt(mass));
                double before = square;
                square = stiffness / mass;
                v = next;
                if (Math.Abs(square - before) <= Settled * Math.Abs(square))
                {
                    break;
                }
            }
            RodVector[] timesMass = TimesMass(v);
            _system.Project(timesMass);
            _found.Add(v);
            _foundTimesMass.Add(timesMass);
            return square;
        }

        private RodVector[] TimesMass(RodVector[] v)
        {
            var result = new RodVector[v.Length];
            for (int i = 0; i < _mass.Diagonal.Length; i++)
            {
                result[i].AddX(_mass.Diagonal[i] * v[i].X);
                if (i < _mass.Coupling.Length)
                {
                    result[i].AddX(_mass.Coupling[i] * v[i + 1].X);
                    result[i + 1].AddX(_mass.Coupling[i] * v[i].X);
                    result[i].T1 = _mass.Rotary[i].X * v[i].T1;
                    result[i].T2 = _mass.Rotary[i].Y * v[i].T2;
                    result[i].T3 = _mass.Rotary[i].Z * v[i].T3;
                }
            }
            return result;
        }

        private Vector3d[] Shift(RodVector[] mode)
        {
            var shift = new Vector3d[Positions.Length];
            double largest = 0.0;
            double turn = 0.0;
            for (int i = 0; i < shift.Length; i++)
            {
                shift[i] = mode[i].X;
                largest = Math.Max(largest, shift[i].Length);
                turn = Math.Max(turn, mode[i].T.Length);
            }
            bool isTwist = largest <= Still * _length * turn;
            return Array.ConvertAll(shift, s => isTwist ? Vector3d.Zero : s / largest);
        }
    }
}
