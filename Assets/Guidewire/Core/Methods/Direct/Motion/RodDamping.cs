using System;

namespace Guidewire.Core
{
    /// <summary>Damping of a material in an implicit stage: mass-proportional, force -a M v, and that of the material
    /// (Kelvin-Voigt), stress b K times the rate of strain. With the couple -a I w of <see cref="InertiaEnergy"/> a
    /// mode of circular frequency w has the damping ratio a/(2 w) + b w/2, independent of the time step.</summary>
    /// <remarks>Positions and all strains y are integrated by the scheme's own formula: in a stage of length h,
    /// y = y^ + h y' with y^ what earlier stages contributed. So y' = (y - y^)/h, and what resists it with coefficient
    /// c has the energy c/(2 h) |y - y^|^2 in the stage: springs like those of the wire, b/h times as stiff and at rest
    /// in y^. The rates of an explicit first stage follow from velocities and spins, whatever went before.</remarks>
    internal sealed class RodDamping : EnergyTerm
    {
        private readonly double _ofMass;      // a, 1/s
        private readonly double _ofMaterial;  // b, s; where it is 0 no strain is measured
        private readonly RodMass _mass;
        private readonly MaterialRod _rod;
        private readonly RodSupports _supports;
        private readonly Joint[] _elastic;
        private readonly Joint[] _joint;      // those of the elastic energy, times b/h
        private readonly BendTwistTerm _bending;
        private readonly StretchEnergy _stretch;
        private readonly MaterialRod _dashpot;
        private readonly Measures _now;
        private readonly Measures _begun;     // at the step's start
        private readonly Measures _before;    // at the start of the step before
        private readonly Measures _history;   // y^
        private readonly Measures[] _rate;    // y' by stage
        private double _perStage;             // 1/h, 1/s; 0 before the first stage
        private Vector3d[]? _around;          // velocities of what drag acts against, m/s
        private bool _hasBegun;
        private bool _hasBefore;

        /// <summary>Makes the damping of a rod.</summary>
        /// <param name="stages">Of the scheme.</param>
        public RodDamping(RodTerms terms, int stages)
        {
            _rod = terms.Rod;
            _mass = terms.Mass;
            _ofMass = _rod.MassDamping;
            _ofMaterial = _rod.MaterialDamping;
            int n = _rod.Capacity;
            _supports = terms.Supports;
            _elastic = _rod.Joints(terms.Supports);
            _joint = new Joint[n + 1];
            _bending = BendTwistTerm.Create(_joint, terms.Supports);
            _dashpot = new MaterialRod(_rod.ElementCount, n);
            Array.Copy(_rod.Length, _dashpot.Length, n);
            _now = new Measures(n);
            _begun = new Measures(n);
            _before = new Measures(n);
            _history = new Measures(n);
            _rate = new Measures[stages];
            for (int s = 0; s < stages; s++)
            {
                _rate[s] = new Measures(n);
            }
            _stretch = new StretchEnergy(_dashpot, _history.Chord);
        }

        /// <inheritdoc/>
        public override void Remesh()
        {
            _rod.SetJoints(_supports, _elastic);
            Array.Clear(_joint, 0, _joint.Length);
            _bending.Remesh();
            _dashpot.ElementCount = _rod.ElementCount;
            Array.Copy(_rod.Length, _dashpot.Length, _rod.ElementCount);
            _begun.Clear();
            _before.Clear();
            _history.Clear();
            Array.ForEach(_rate, rate => rate.Clear());
            (_perStage, _hasBegun, _hasBefore) = (0.0, false, false);
        }

        /// <summary>A step begins in this shape; its rates are those of an explicit first stage.</summary>
        /// <param name="velocities">Of the nodes, m/s.</param>
        /// <param name="spins">Of the elements along their own axes, rad/s.</param>
        /// <param name="proximal">Spin of the proximal frame along its own axes, rad/s.</param>
        /// <param name="distal">Spin of the distal frame.</param>
        public void Begin(RodShape shape, Vector3d[] velocities, Vector3d[] spins, in Vector3d proximal,
            in Vector3d distal)
        {
            _hasBefore = _hasBegun;
            _hasBegun = true;
            Anchor(shape);
            _before.CopyFrom(_begun);
            Measure(shape, _begun);
            Measures first = _rate[0];
            Array.Copy(velocities, first.Position, shape.ElementCount + 1);
            if (_ofMaterial == 0.0)
            {
                return;
            }
            _bending.MeasureRates(shape, spins, proximal, distal, first.Joint);
            for (int j = 0; j < shape.ElementCount; j++)
            {
                // p = R^T (x+ - x)/l and R' = R [w], so p' = R^T (v+ - v)/l - w x p.
                Vector3d change = (1.0 / _rod.Length[j]) * (velocities[j + 1] - velocities[j]);
                first.Chord[j] = Quaterniond.Rotate(shape.Q[j].Conjugate, change)
                    - Vector3d.Cross(spins[j], _begun.Chord[j]);
            }
        }

        /// <summary>The damping acts by the rates at the step's start.</summary>
        /// <param name="h">Any time that is not short beside the rates, s: y^ = y - h y'.</param>
        public void TakeMoment(double h)
        {
            _history.CopyFrom(_begun);
            _history.Add(-h, _rate[0]);
            SetSprings(1.0 / h);
        }

        /// <summary>A stage of a Runge-Kutta scheme begins.</summary>
        /// <param name="row">a_ik; its length is the stage's index plus 1.</param>
        /// <param name="dt">The step, s.</param>
        public void BeginStage(double[] row, double dt)
        {
            int stage = row.Length - 1;
            _history.CopyFrom(_begun);
            for (int k = 0; k < stage; k++)
            {
                _history.Add(dt * row[k], _rate[k]);
            }
            SetSprings(1.0 / (dt * row[stage]));
        }

        /// <summary>The one stage of a step of BDF2 begins: y^ = 4/3 y_0 - 1/3 y_-1, which is y_0 + h/2 y'_0 where y_-1
        /// is not known.</summary>
        /// <param name="isTwoStep">False for a first step, which is one of implicit Euler.</param>
        /// <param name="h">The stage's length, s.</param>
        public void BeginStage(bool isTwoStep, double h)
        {
            _history.CopyFrom(_begun);
            if (isTwoStep && _hasBefore)
            {
                _history.Add(1.0 / 3.0, _begun);
                _history.Add(-1.0 / 3.0, _before);
            }
            else if (isTwoStep)
            {
                _history.Add(0.5 * h, _rate[0]);
            }
            SetSprings(1.0 / h);
        }

        /// <summary>Drag acts against what is around the nodes; null: it is at rest.</summary>
        /// <param name="velocities">Of that, m/s, in this stage.</param>
        public void SetSurrounding(Vector3d[]? velocities) => _around = velocities;

        /// <summary>A stage has been solved in this shape.</summary>
        public void EndStage(int stage, RodShape shape)
        {
            Measure(shape, _now);
            _rate[stage].SetDifference(_perStage, _now, _history);
        }

        /// <summary>What the damping adds to the couple of the proximal clamp on the rod, N m, along the world's axes.
        /// </summary>
        public Vector3d ProximalCouple(RodShape shape) =>
            _ofMaterial > 0.0 ? _bending.ProximalCouple(shape) : Vector3d.Zero;

        /// <summary>Gives the same for the distal clamp.</summary>
        public Vector3d DistalCouple(RodShape shape) =>
            _ofMaterial > 0.0 ? _bending.DistalCouple(shape) : Vector3d.Zero;

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            double sum = 0.0;
            if (_ofMaterial > 0.0)
            {
                sum += _bending.Value(shape) + _stretch.Value(shape);
            }
            if (_ofMass > 0.0)
            {
                double scale = _ofMass * _perStage;
                Vector3d next = Dragged(shape, 0);
                int n = shape.ElementCount;
                for (int i = 0; i <= n; i++)
                {
                    Vector3d d = next;
                    sum += 0.5 * scale * _mass.Diagonal[i] * d.LengthSquared;
                    if (i < n)
                    {
                        next = Dragged(shape, i + 1);
                        sum += scale * _mass.Coupling[i] * Vector3d.Dot(d, next);
                    }
                }
            }
            return sum;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            if (_ofMaterial > 0.0)
            {
                _bending.AddGradient(shape, gradient, from, to, ref measured);
                _stretch.AddGradient(shape, gradient, from, to, ref measured);
            }
            if (_ofMass > 0.0)
            {
                AddDrag(shape, gradient, from, to);
            }
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            if (_ofMaterial > 0.0)
            {
                _bending.AddBlocks(shape, blocks, gradient, from, to);
                _stretch.AddBlocks(shape, blocks, gradient, from, to);
            }
            if (_ofMass > 0.0)
            {
                AddDrag(shape, gradient, from, to);
                double scale = _ofMass * _perStage;
                int n = shape.ElementCount;
                for (int i = from; i < Math.Min(to, n + 1); i++)
                {
                    ref RodBlock b = ref blocks[i];
                    b.A11 += scale * _mass.Diagonal[i];
                    b.A22 += scale * _mass.Diagonal[i];
                    b.A33 += scale * _mass.Diagonal[i];
                    if (i < n)
                    {
                        b.D11 += scale * _mass.Coupling[i];
                        b.D22 += scale * _mass.Coupling[i];
                        b.D33 += scale * _mass.Coupling[i];
                    }
                }
            }
        }

        /// <inheritdoc/>
        public override void Anchor(RodShape shape)
        {
            if (_ofMaterial > 0.0)
            {
                _bending.Anchor(shape);
            }
        }

        /// <inheritdoc/>
        public override double AnchoredValue(double before) => _bending.AnchoredValue(before);

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            _bending.Serialize(snapshot);
            snapshot.Serialize(ref _hasBegun);
            snapshot.Serialize(ref _perStage);
            _begun.Serialize(snapshot, _rod.ElementCount);
            _history.Serialize(snapshot, _rod.ElementCount);
            if (!snapshot.IsWritten)
            {
                // Damping by mass alone measures no strains: a snapshot written under it has none, and it keeps none.
                _hasBegun &= _ofMaterial == 0.0 || _begun.HasStrains;
                if (_ofMaterial == 0.0)
                {
                    _begun.ForgetStrains();
                }
                SetSprings(_perStage);
            }
        }

        // h times the velocity against what is around, m.
        private Vector3d Dragged(RodShape shape, int i)
        {
            Vector3d moved = shape.X[i] - _history.Position[i];
            return _around == null ? moved : moved - (1.0 / _perStage) * _around[i];
        }

        private void AddDrag(RodShape shape, RodVector[] gradient, int from, int to)
        {
            double scale = _ofMass * _perStage;
            int last = Math.Min(to, _mass.ElementCount);
            Vector3d moved = Dragged(shape, from);
            Vector3d sum = gradient[from].X;
            for (int i = from; i < last; i++)
            {
                Vector3d d = scale * moved;
                moved = Dragged(shape, i + 1);
                sum = sum + _mass.Diagonal[i] * d + (scale * _mass.Coupling[i]) * moved;
                gradient[i].X = sum;
                sum = gradient[i + 1].X + _mass.Coupling[i] * d;
            }
            if (last < to && last <= _mass.ElementCount)
            {
                sum += _mass.Diagonal[last] * (scale * moved);
            }
            if (last <= _mass.ElementCount)
            {
                gradient[last].X = sum;
            }
        }

        /// <summary>Sets springs of b/h, at rest in y^.</summary>
        private void SetSprings(double perStage)
        {
            _perStage = perStage;
            if (_ofMaterial == 0.0)
            {
                return;
            }
            double scale = _ofMaterial * perStage;
            for (int k = 0; k <= _rod.ElementCount; k++)
            {
                _joint[k] = new Joint
                {
                    Bend1 = scale * _elastic[k].Bend1,
                    Bend2 = scale * _elastic[k].Bend2,
                    Twist = scale * _elastic[k].Twist,
                    Rest = _history.Joint[k],
                };
            }
            for (int j = 0; j < _dashpot.ElementCount; j++)
            {
                _dashpot.ShearStiffness[j] = scale * _rod.ShearStiffness[j];
                _dashpot.StretchStiffness[j] = scale * _rod.StretchStiffness[j];
            }
        }

        private void Measure(RodShape shape, Measures to)
        {
            Array.Copy(shape.X, to.Position, shape.ElementCount + 1);
            if (_ofMaterial == 0.0)
            {
                return;
            }
            _bending.Measure(shape, to.Joint);
            for (int j = 0; j < _dashpot.ElementCount; j++)
            {
                _stretch.Stress(shape, j, out to.Chord[j]);
            }
        }

        /// <summary>All that is resisted: y.</summary>
        private sealed class Measures
        {
            public Measures(int n)
            {
                Joint = new Vector3d[n + 1];
                Chord = new Vector3d[n];
                Position = new Vector3d[n + 1];
            }

            public Vector3d[] Joint { get; }     // as the joints' law measures their turn

            public Vector3d[] Chord { get; }     // p, over the element's length

            public Vector3d[] Position { get; }  // m

            /// <summary>Whether strains were measured: a chord has a length.</summary>
            public bool HasStrains => Chord[0] != Vector3d.Zero;

            public void Clear()
            {
                ForgetStrains();
                Array.Clear(Position, 0, Position.Length);
            }

            public void ForgetStrains()
            {
                Array.Clear(Joint, 0, Joint.Length);
                Array.Clear(Chord, 0, Chord.Length);
            }

            public void CopyFrom(Measures other)
            {
                Array.Copy(other.Joint, Joint, Joint.Length);
                Array.Copy(other.Chord, Chord, Chord.Length);
                Array.Copy(other.Position, Position, Position.Length);
            }

            public void Add(double weight, Measures other)
            {
                Add(Joint, weight, other.Joint);
                Add(Chord, weight, other.Chord);
                Add(Position, weight, other.Position);
            }

            public void SetDifference(double scale, Measures a, Measures b)
            {
                Set(Joint, scale, a.Joint, b.Joint);
                Set(Chord, scale, a.Chord, b.Chord);
                Set(Position, scale, a.Position, b.Position);
            }

            public void Serialize(Snapshot snapshot, int elementCount)
            {
                snapshot.Serialize(Joint, elementCount + 1);
                snapshot.Serialize(Chord, elementCount);
                snapshot.Serialize(Position, elementCount + 1);
            }

            private static void Add(Vector3d[] to, double weight, Vector3d[] what)
            {
                for (int i = 0; i < to.Length; i++)
                {
                    to[i] += weight * what[i];
                }
            }

            private static void Set(Vector3d[] to, double scale, Vector3d[] a, Vector3d[] b)
            {
                for (int i = 0; i < to.Length; i++)
                {
                    to[i] = scale * (a[i] - b[i]);
                }
            }
        }
    }
}
