using System;

namespace Guidewire.Core
{
    /// <summary>The linear system of a rod: n+1 blocks over (x_i, theta_i), the last theta a placeholder. Assembles the
    /// terms, eliminates the supports, factorises by LDL^T and solves, all in O(n).</summary>
    /// <remarks>A long rod is assembled and eliminated piece by piece, so that a block is still in the cache when it is
    /// eliminated. At a support the fixed direction's row and column become those of the unit matrix. A rod with an
    /// instrument inside it has one twist angle more for each element, with two of them two: its vectors go on, behind
    /// the placeholder, with one entry an element, whose T3 is the first angle's and T2 the second one's.</remarks>
    internal sealed class BlockTridiagonal
    {
        private const int Piece = 32;  // blocks; 12 KB

        private readonly RodBlock[] _block;
        private readonly MaterialRod _rod;
        private readonly double[] _weight;  // of theta_i in the metric, m
        private int _count;
        private double _perLengthSquared;
        private readonly bool _holdsStart;
        private readonly DistalEnd _distalEnd;
        private readonly Vector3d _slidingAxis;
        private readonly CoaxialJoints? _coaxial;
        private readonly TwistRow[] _twist = Array.Empty<TwistRow>();   // of the first angles, then of the second
        private readonly bool _isPair;      // whether there are second ones
        private int _entryCount;            // of vectors, behind the placeholder
        private int _twistCount;            // elements with an angle that is unknown
        private readonly LowRank _columns;  // what couples elements that are not neighbours
        private readonly int _vesselCount;  // of vectors of a vessel, at their end

        /// <summary>Makes a system for this rod between these supports.</summary>
        /// <param name="vesselCount">Splines of a vessel that gives way as a beam: the border of the matrix.</param>
        public BlockTridiagonal(MaterialRod rod, RodSupports supports, int vesselCount = 0)
        {
            _vesselCount = vesselCount;
            _rod = rod;
            _block = new RodBlock[rod.Capacity + 2];
            _weight = new double[rod.Capacity + 1];
            _holdsStart = supports.Proximal != ProximalEnd.Free && !supports.HasSpring;
            _distalEnd = supports.Distal;
            _slidingAxis = supports.SlidingAxis;
            _coaxial = supports.InnerCount > 0 ? supports.Coaxial!.Joints : null;
            if (_coaxial != null)
            {
                _isPair = _coaxial.InnerCount > 1;
                _twist = new TwistRow[_coaxial.InnerCount * (rod.Capacity + 1)];
            }
            _columns = new LowRank(VectorCapacity, 3 * vesselCount);
            Remesh();
        }

        /// <summary>The rod has other elements.</summary>
        public void Remesh()
        {
            _count = _rod.ElementCount + 1;
            _entryCount = _coaxial == null ? 0 : _count;
            Array.Copy(_rod.Length, _weight, _rod.ElementCount);
            _weight[_count - 1] = _rod.Length[_rod.ElementCount - 1];
            _perLengthSquared = 1.0 / (_rod.TotalLength * _rod.TotalLength);
        }

        // How far rows of second angles are behind those of the first ones; 0: there are none.
        private int Second => _isPair ? _count : 0;

        /// <summary>Number of blocks: one more than the rod has elements.</summary>
        public int BlockCount => _count;

        /// <summary>Whether instruments inside have angles of their own.</summary>
        public bool HasTwistAngles => _twistCount > 0;

        /// <summary>Number of vectors that a right-hand side must hold: one more than there are blocks, as many as
        /// blocks again where there are twist angles, and those of a vessel.</summary>
        public int VectorCount => VesselStart + _vesselCount;

        /// <summary>Where those of a vessel begin.</summary>
        public int VesselStart => _count + 1 + _entryCount;

        /// <summary>The same of the most elements that the rod may have.</summary>
        public int VectorCapacity => (_coaxial == null ? 1 : 2) * (_rod.Capacity + 1) + 1 + _vesselCount;

        /// <summary>Assembles gradient and blocks of all terms, adds shift times the metric (l on theta, l/L^2 on x),
        /// and factorises; with it goes the right-hand side -gradient.</summary>
        /// <param name="onlyPositive">Ends at the first eigenvalue that is not, unless pieces that are not neighbours
        /// are coupled: gradient and y are incomplete.</param>
        /// <returns>The number of eigenvalues that are not positive: 0 when the energy is convex here.</returns>
        public int Factorise(EnergyTerm[] terms, RodShape shape, RodVector[] gradient, RodVector[] y, double shift,
            bool onlyPositive = false)
        {
            int last = _count - 1;
            _columns.Clear();
            foreach (EnergyTerm term in terms)
            {
                term.AddColumns(shape, _columns);
            }
            onlyPositive &= _columns.Count == 0;
            y[0] = default;
            gradient[0] = default;
            _block[0] = default;
            BeginTwists(gradient, y);
            Array.Clear(gradient, VesselStart, _vesselCount);
            int negative = 0;
            int from = 0;
            while (from < _count && !(onlyPositive && negative > 0))
            {
                int to = from + Piece < last ? from + Piece : _count;
                Array.Clear(_block, from + 1, to - from);
                Array.Clear(gradient, from + 1, to - from);
                Array.Clear(y, from + 1, to - from);
                for (int k = 0; k < terms.Length; k++)
                {
                    terms[k].AddBlocks(shape, _block, gradient, from, to);
                }
                if (_twistCount > from)
                {
                    AssembleTwists(terms, shape, shift, from, to);
                }
                if (shift != 0.0)
                {
                    AddShift(shift, from, to);
                }
                if (from == 0)
                {
                    HoldStart();
                }
                if (to == _count)
                {
                    HoldEnd();
                }
                Subtract(gradient, y, from, to);
                int twists = Math.Min(to, Math.Max(from, _twistCount));
                for (int i = from; i < twists; i++)
                {
                    negative += Eliminate(y, i, i + 1);
                    ref RodVector z = ref y[_count + 1 + i];
                    ref RodVector nextZ = ref y[_count + 2 + i];
                    z.T3 -= gradient[_count + 1 + i].T3;
                    z.T2 -= gradient[_count + 1 + i].T2;
                    negative += TwistElimination.Eliminate(_block[i], ref _block[i + 1], _twist, i, Second, y[i],
                        ref y[i + 1], ref z, ref nextZ);
                }
                if (twists < to)
                {
                    negative += Eliminate(y, twists, to);
                }
                from = to;
            }
            SubtractVessel(gradient, y);
            // A border can only add eigenvalues that are not positive.
            return _columns.IsEmpty || (onlyPositive && negative > 0) ? negative : negative + _columns.Factorise(this);
        }

        private int Eliminate(RodVector[] y, int from, int to)
        {
#if NET8_0_OR_GREATER
            if (Rows4.IsSupported)
            {
                return EliminationLanes.Eliminate(_block, y, from, to);
            }
#endif
            int negative = 0;
            for (int i = from; i < to; i++)
            {
                negative += BlockElimination.Eliminate(ref _block[i], ref _block[i + 1], ref y[i], ref y[i + 1]);
            }
            return negative;
        }

        /// <summary>Gives y := -gradient with the supports removed; gradient itself retains the reactions.</summary>
        /// <returns>What the terms measured in passing.</returns>
        public GradientMeasures Gradient(EnergyTerm[] terms, RodShape shape, RodVector[] gradient, RodVector[] y)
        {
            var measured = default(GradientMeasures);
            Array.Clear(gradient, 0, VectorCount);
            for (int k = 0; k < terms.Length; k++)
            {
                terms[k].AddGradient(shape, gradient, 0, _count, ref measured);
            }
            Array.Clear(y, 0, VectorCount);
            Subtract(gradient, y, 0, _count);
            SubtractVessel(gradient, y);
            if (_coaxial != null)
            {
                int twists = _coaxial.ActiveCount;
                for (int j = 0; j < twists; j++)
                {
                    y[_count + 1 + j].T3 = -gradient[_count + 1 + j].T3;
                    y[_count + 1 + j].T2 = -gradient[_count + 1 + j].T2;
                }
            }
            return measured;
        }

        /// <summary>Computes y := A^-1 y with the current factorisation.</summary>
        public void Solve(RodVector[] y)
        {
            SolveWithout(y);
            Correct(y);
        }

        /// <summary>The same without what couples pieces that are not neighbours.</summary>
        public void SolveWithout(RodVector[] y)
        {
            y[_count] = default;
            for (int i = 0; i < _count; i++)
            {
                BlockElimination.Forward(_block[i], ref y[i], ref y[i + 1]);
                if (i < _twistCount)
                {
                    TwistElimination.Forward(_twist, i, Second, y[i], ref y[i + 1], ref y[_count + 1 + i],
                        ref y[_count + 2 + i]);
                }
            }
            BackWithout(y);
        }

        /// <summary>The same of four right-hand sides, which begin at a block, without twist angles.</summary>
        /// <param name="from">The first block that is not 0.</param>
        /// <param name="lowest">The first one whose solution counts.</param>
        public void SolveWithout(RodVector4[] y, int from, int lowest)
        {
            for (int i = from; i < _count; i++)
            {
                RodVector4.Forward(_block[i], ref y[i], ref y[i + 1]);
            }
            y[_count] = default;
            for (int i = _count - 1; i >= lowest; i--)
            {
                RodVector4.Backward(_block[i], ref y[i], y[i + 1]);
            }
        }

        /// <summary>Does the second half of <see cref="Solve"/>, after a <see cref="Factorise"/> that took y
        /// along.</summary>
        public void Back(RodVector[] y)
        {
            BackWithout(y);
            Correct(y);
        }

        private void Correct(RodVector[] y)
        {
            if (!_columns.IsEmpty)
            {
                _columns.Correct(this, y);
            }
        }

        private void BackWithout(RodVector[] y)
        {
            y[_count] = default;
            for (int i = _count - 1; i >= 0; i--)
            {
                if (i < _twistCount)
                {
                    TwistElimination.Backward(_twist, i, Second, ref y[i], y[i + 1], ref y[_count + 1 + i],
                        i + 1 < _twistCount ? y[_count + 2 + i] : default);
                }
                BlockElimination.Backward(_block[i], ref y[i], y[i + 1]);
            }
        }

        /// <summary>Changes the sign of all negative pivots of the factorisation, L D L^T to L |D| L^T, and of what has
        /// been divided by them: what a <see cref="Factorise"/> has left for <see cref="Back"/> then leads downhill.
        /// </summary>
        /// <returns>Whether it does: not where what borders the matrix is still not positive.</returns>
        public bool ReflectNegativePivots(RodVector[] y)
        {
            for (int i = 0; i < _count; i++)
            {
                ref RodBlock b = ref _block[i];
                ref RodVector v = ref y[i];
                Reflect(ref b.A11, ref v.X1);
                Reflect(ref b.A22, ref v.X2);
                Reflect(ref b.A33, ref v.X3);
                Reflect(ref b.C11, ref v.T1);
                Reflect(ref b.C22, ref v.T2);
                Reflect(ref b.C33, ref v.T3);
            }
            return _columns.IsEmpty || _columns.Reflect(this);
        }

        private static void Reflect(ref double inverse, ref double value)
        {
            if (inverse < 0.0)
            {
                inverse = -inverse;
                value = -value;
            }
        }

        /// <summary>Takes the fixed directions out of the vectors of an element's two nodes.</summary>
        public void Hold(int j, ref RodVector node, ref RodVector next)
        {
            if (j == 0)
            {
                ProjectStart(ref node);
            }
            if (j == _count - 2)
            {
                ProjectEnd(ref next);
            }
        }

        /// <summary>Takes the fixed directions out of a vector.</summary>
        public void Project(RodVector[] v)
        {
            ProjectStart(ref v[0]);
            ProjectEnd(ref v[_count - 1]);
            for (int j = 0; j < _entryCount; j++)
            {
                ref RodVector z = ref v[_count + 1 + j];
                z = new RodVector
                {
                    T3 = j < _coaxial!.ActiveCountOf(1) ? z.T3 : 0.0,
                    T2 = _isPair && j < _coaxial.ActiveCountOf(2) ? z.T2 : 0.0,
                };
            }
        }

        /// <summary>Gives a . b over all free directions, weighted by the metric: l on theta, l/L^2 on x.</summary>
        public double MetricDot(RodVector[] a, RodVector[] b)
        {
            double sum = 0.0;
            for (int i = 0; i < _count; i++)
            {
                double x = a[i].X1 * b[i].X1 + a[i].X2 * b[i].X2 + a[i].X3 * b[i].X3;
                double t = a[i].T1 * b[i].T1 + a[i].T2 * b[i].T2 + a[i].T3 * b[i].T3;
                sum += _weight[i] * (t + _perLengthSquared * x);
            }
            for (int j = 0; j < _entryCount; j++)
            {
                sum += _weight[j] * a[_count + 1 + j].T3 * b[_count + 1 + j].T3;
                sum += _weight[j] * a[_count + 1 + j].T2 * b[_count + 1 + j].T2;
            }
            return sum;
        }

        /// <summary>v := metric times v.</summary>
        public void ApplyMetric(RodVector[] v)
        {
            for (int i = 0; i < _count; i++)
            {
                double t = _weight[i];
                double x = t * _perLengthSquared;
                v[i].X1 *= x;
                v[i].X2 *= x;
                v[i].X3 *= x;
                v[i].T1 *= t;
                v[i].T2 *= t;
                v[i].T3 *= t;
            }
            for (int j = 0; j < _entryCount; j++)
            {
                v[_count + 1 + j].T3 *= _weight[j];
                v[_count + 1 + j].T2 *= _weight[j];
            }
        }

        private void BeginTwists(RodVector[] gradient, RodVector[] y)
        {
            if (_coaxial == null)
            {
                return;
            }
            _twistCount = _coaxial.ActiveCount;
            Array.Clear(_twist, 0, _coaxial.InnerCount * _count);
            Array.Clear(gradient, _count + 1, _count);
            Array.Clear(y, _count + 1, _count);
        }

        private void AssembleTwists(EnergyTerm[] terms, RodShape shape, double shift, int from, int to)
        {
            int end = Math.Min(to, _twistCount);
            for (int k = 0; k < terms.Length; k++)
            {
                terms[k].AddTwistRows(shape, _twist, from, end);
            }
            for (int j = from; j < end; j++)
            {
                _twist[j].Diagonal += shift * _weight[j];
                if (_isPair)
                {
                    // One that is not unknown keeps a row of the unit matrix.
                    _twist[j].Diagonal += j < _coaxial!.ActiveCountOf(1) ? 0.0 : 1.0;
                    _twist[_count + j].Diagonal += shift * _weight[j]
                        + (j < _coaxial.ActiveCountOf(2) ? 0.0 : 1.0);
                }
            }
        }

        private void SubtractVessel(RodVector[] gradient, RodVector[] y)
        {
            for (int i = VesselStart; i < VectorCount; i++)
            {
                y[i] = default;
                y[i].AddX(-gradient[i].X);
            }
        }

        /// <summary>y -= gradient where nothing is held.</summary>
        private void Subtract(RodVector[] gradient, RodVector[] y, int from, int to)
        {
            RodVector start = gradient[0];
            RodVector end = gradient[_count - 1];
            ProjectStart(ref gradient[0]);
            ProjectEnd(ref gradient[_count - 1]);
            for (int i = from; i < to; i++)
            {
                y[i].AddX(-gradient[i].X);
                y[i].AddT(-gradient[i].T);
            }
            gradient[0] = start;
            gradient[_count - 1] = end;
        }

        private void ProjectStart(ref RodVector v)
        {
            if (_holdsStart)
            {
                v.X = Vector3d.Zero;
            }
        }

        private void ProjectEnd(ref RodVector v)
        {
            v.T1 = 0.0;
            v.T2 = 0.0;
            v.T3 = 0.0;
            if (_distalEnd == DistalEnd.Free)
            {
                return;
            }
            v.X = _distalEnd == DistalEnd.Sliding ? Vector3d.Dot(_slidingAxis, v.X) * _slidingAxis : Vector3d.Zero;
        }

        private void AddShift(double shift, int from, int to)
        {
            for (int i = from; i < to; i++)
            {
                double t = shift * _weight[i];
                double x = t * _perLengthSquared;
                ref RodBlock b = ref _block[i];
                b.A11 += x;
                b.A22 += x;
                b.A33 += x;
                b.C11 += t;
                b.C22 += t;
                b.C33 += t;
            }
        }

        private void HoldStart()
        {
            if (!_holdsStart)
            {
                return;
            }
            ref RodBlock b = ref _block[0];
            b.A11 = 1.0; b.A22 = 1.0; b.A33 = 1.0;
            b.A21 = 0.0; b.A31 = 0.0; b.A32 = 0.0;
            b.B11 = 0.0; b.B12 = 0.0; b.B13 = 0.0;
            b.B21 = 0.0; b.B22 = 0.0; b.B23 = 0.0;
            b.B31 = 0.0; b.B32 = 0.0; b.B33 = 0.0;
            b.D11 = 0.0; b.D12 = 0.0; b.D13 = 0.0;
            b.D21 = 0.0; b.D22 = 0.0; b.D23 = 0.0;
            b.D31 = 0.0; b.D32 = 0.0; b.D33 = 0.0;
        }

        private void HoldEnd()
        {
            ref RodBlock b = ref _block[_count - 2];
            ref RodBlock end = ref _block[_count - 1];
            b.F11 = 0.0; b.F12 = 0.0; b.F13 = 0.0;
            b.F21 = 0.0; b.F22 = 0.0; b.F23 = 0.0;
            b.F31 = 0.0; b.F32 = 0.0; b.F33 = 0.0;
            end.C11 = 1.0; end.C22 = 1.0; end.C33 = 1.0;
            end.C21 = 0.0; end.C31 = 0.0; end.C32 = 0.0;
            if (_distalEnd == DistalEnd.Free)
            {
                return;
            }
            // With P the projection on the axis along which the end may slide (0 if held): rows P D and P E of the
            // element before, and P A P + 1 - P for the end itself.
            Vector3d a = _distalEnd == DistalEnd.Sliding ? _slidingAxis : Vector3d.Zero;
            double d1 = a.X * b.D11 + a.Y * b.D21 + a.Z * b.D31;
            double d2 = a.X * b.D12 + a.Y * b.D22 + a.Z * b.D32;
            double d3 = a.X * b.D13 + a.Y * b.D23 + a.Z * b.D33;
            b.D11 = a.X * d1; b.D12 = a.X * d2; b.D13 = a.X * d3;
            b.D21 = a.Y * d1; b.D22 = a.Y * d2; b.D23 = a.Y * d3;
            b.D31 = a.Z * d1; b.D32 = a.Z * d2; b.D33 = a.Z * d3;
            double e1 = a.X * b.E11 + a.Y * b.E21 + a.Z * b.E31;
            double e2 = a.X * b.E12 + a.Y * b.E22 + a.Z * b.E32;
            double e3 = a.X * b.E13 + a.Y * b.E23 + a.Z * b.E33;
            b.E11 = a.X * e1; b.E12 = a.X * e2; b.E13 = a.X * e3;
            b.E21 = a.Y * e1; b.E22 = a.Y * e2; b.E23 = a.Y * e3;
            b.E31 = a.Z * e1; b.E32 = a.Z * e2; b.E33 = a.Z * e3;
            double along = a.X * a.X * end.A11 + a.Y * a.Y * end.A22 + a.Z * a.Z * end.A33
                + 2.0 * (a.X * a.Y * end.A21 + a.X * a.Z * end.A31 + a.Y * a.Z * end.A32) - 1.0;
            end.A11 = 1.0 + along * a.X * a.X;
            end.A22 = 1.0 + along * a.Y * a.Y;
            end.A33 = 1.0 + along * a.Z * a.Z;
            end.A21 = along * a.X * a.Y;
            end.A31 = along * a.X * a.Z;
            end.A32 = along * a.Y * a.Z;
        }
    }
}
