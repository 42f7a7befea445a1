using System;

namespace Guidewire.Core
{
    /// <summary>The external forces on a moving rod: in its last stage, and their means over the last step by the
    /// scheme's weights.</summary>
    internal sealed class RodReactions
    {
        private const int MinApart = 3;     // elements, of which the first and the last have no node in common

        private readonly RodTerms _terms;
        private readonly RodSchedule _schedule;
        private readonly RodMotion _motion;
        private readonly EnergyTerm[] _moving;
        private readonly BalanceRounding _rounding;
        private readonly RodDamping? _damping;
        private readonly RodVector[] _gradient;
        private readonly RodVector[] _loads;
        private StageForces _end;
        private StageForces _mean;
        private bool _hasStepped;

        /// <summary>Makes one of a rod at its start.</summary>
        /// <param name="moving">Its terms and those of its motion.</param>
        /// <param name="rounding">What rounding of positions leaves in the balance.</param>
        /// <param name="damping">What resists velocities and rates of strain, or null.</param>
        public RodReactions(RodTerms terms, RodSchedule schedule, RodMotion motion, EnergyTerm[] moving,
            BalanceRounding rounding, RodDamping? damping)
        {
            _terms = terms;
            _schedule = schedule;
            _motion = motion;
            _moving = moving;
            _rounding = rounding;
            _damping = damping;
            _gradient = new RodVector[terms.VectorCapacity];
            _loads = new RodVector[terms.VectorCapacity];
        }

        /// <summary>Whether forces are kept; they cost a gradient a stage.</summary>
        public bool AreKept { get; set; }

        /// <summary>The forces from outside in the last stage.</summary>
        public StageForces End => _end;

        /// <summary>Their means over the last step by the scheme's weights (BDF2: at the step's end). That of the
        /// supports on node 0 or n is the stress of the element beside it, less the node's own fraction of weight and
        /// inertia. With loads, walls and what mass-proportional damping takes they are the change of the momentum as
        /// the scheme writes it.</summary>
        public StageForces Mean => _mean;

        /// <summary>The rod has other elements and has not stepped.</summary>
        public void Remesh() => (_end, _mean, _hasStepped) = (default, default, false);

        /// <summary>A step begins.</summary>
        public void BeginStep() => _mean = default;

        /// <summary>Takes the forces of a stage that is solved.</summary>
        public void TakeStage()
        {
            _hasStepped = true;
            if (AreKept)
            {
                _terms.Walls()?.Barrier.Value(_motion.Shape);
                AddEnds();
                Record(new StageForces
                {
                    Proximal = _gradient[0].X,
                    Distal = _gradient[_motion.Shape.ElementCount].X,
                });
            }
        }

        /// <summary>Takes the forces that nodes 0 and n need to be where they are, with the loads, and with what walls
        /// and the hub add between walls, as those of the last stage.</summary>
        public void Record(StageForces supports)
        {
            _end = supports;
            _end.Load = LoadSum();
            WallTerms? walls = _terms.Walls();
            if (walls != null)
            {
                _end.Proximal = walls.SupportForce(_motion.Shape) + _end.Proximal;
                Array.Clear(_loads, 0, _motion.Shape.ElementCount + 2);
                walls.AddWallGradient(_motion.Shape, _loads);
                _end.Walls = -SumOfLoads();
                _end.HubTorque = HubTorque;
            }
        }

        /// <summary>Adds the forces of the last stage to the means with a weight.</summary>
        public void AddStage(double weight)
        {
            if (AreKept)
            {
                _mean.Add(weight, _end);
            }
        }

        /// <summary>Adds impulses, N s, over a step of dt, s.</summary>
        public void AddImpulse(in StageForces impulses, double dt) => _mean.Add(1.0 / dt, impulses);

        /// <summary>Sum of the forces of all loads, N, whose time has been set.</summary>
        public Vector3d LoadSum()
        {
            Array.Clear(_loads, 0, _motion.Shape.ElementCount + 2);
            _terms.AddLoadGradient(_motion.Shape, _loads);
            return -SumOfLoads();
        }

        /// <summary>Force of the supports on a node as the rod is at this time, N.</summary>
        public Vector3d At(int node, double time)
        {
            _terms.SetTime(_schedule, time);
            RodShape shape = _motion.Shape;
            // Before the first step without inertia.
            AddAll(_hasStepped ? _moving : _terms.All);
            WallTerms? walls = _terms.Walls();
            return (node == 0 && walls != null ? walls.SupportForce(shape) : Vector3d.Zero) + _gradient[node].X;
        }

        /// <summary>Torque of the hub on the wire about its axis, N m; that on a wire in a sheath is the slope of the
        /// energy in the hub's turn.</summary>
        public double HubTorque => _terms.Supports.Winds ? _terms.Bending.TurnCouple(_motion.Shape)
            : Vector3d.Dot(ProximalCouple, _terms.HubAxis(_motion.Shape));

        /// <summary>Couple of the proximal clamp on the rod as it is now, N m, along the world's axes; with that of the
        /// damping by the rates of the last stage.</summary>
        public Vector3d ProximalCouple => _terms.Bending.ProximalCouple(_motion.Shape)
            + (_damping == null ? Vector3d.Zero : _damping.ProximalCouple(_motion.Shape));

        /// <summary>The same for the distal clamp.</summary>
        public Vector3d DistalCouple => _terms.Bending.DistalCouple(_motion.Shape)
            + (_damping == null ? Vector3d.Zero : _damping.DistalCouple(_motion.Shape));

        /// <summary>Writes or restores what the next step needs.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(ref _hasStepped);
            snapshot.Serialize(Vector3d.Zero);    // a place that the format has
            _end.Serialize(snapshot);
            if (snapshot.IsStep)
            {
                _mean.Serialize(snapshot);
            }
        }

        // The gradient of terms: what the supports have to exert.
        private void AddAll(EnergyTerm[] terms)
        {
            Array.Clear(_gradient, 0, _terms.VectorCount);
            foreach (EnergyTerm term in terms)
            {
                term.AddGradient(_motion.Shape, _gradient);
            }
            _rounding.SumUp(_gradient);
        }

        // The same of all, where only nodes 0 and n count. Walls, if there are any, have been asked for their energy
        // in this shape last.
        private void AddEnds()
        {
            RodShape shape = _motion.Shape;
            int n = shape.ElementCount;
            if (_rounding.IsLarge || shape.InnerCount > 0 || n < MinApart)
            {
                AddAll(_moving);
                return;
            }
            var measured = default(GradientMeasures);
            Array.Clear(_gradient, 0, _terms.VectorCount);
            foreach (EnergyTerm term in _moving)
            {
                term.AddGradient(shape, _gradient, 0, 1, ref measured);
                term.AddGradient(shape, _gradient, n - 1, n + 1, ref measured);
            }
        }

        private Vector3d SumOfLoads()
        {
            Vector3d sum = Vector3d.Zero;
            for (int i = 0; i <= _motion.Shape.ElementCount; i++)
            {
                sum += _loads[i].X;
            }
            return sum;
        }
    }

    /// <summary>The external forces on a rod in one stage, or their weighted sum, N; the hub's torque, N
    /// m.</summary>
    internal struct StageForces
    {
        public Vector3d Proximal;
        public Vector3d Distal;
        public Vector3d Load;
        public Vector3d Walls;
        public double HubTorque;  // about its axis

        /// <summary>Adds others with a weight.</summary>
        public void Add(double weight, in StageForces other)
        {
            Proximal += weight * other.Proximal;
            Distal += weight * other.Distal;
            Load += weight * other.Load;
            Walls += weight * other.Walls;
            HubTorque += weight * other.HubTorque;
        }

        /// <summary>Writes or restores.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(ref Proximal);
            snapshot.Serialize(ref Distal);
            snapshot.Serialize(ref Load);
            snapshot.Serialize(ref Walls);
            snapshot.Serialize(ref HubTorque);
        }
    }

    /// <summary>Rotates the frames of the clamps as the schedule prescribes; a large rotation is made in parts, each
    /// solved on its own,
    /// so that the rod winds up in the right sense, also beyond half a turn.</summary>
    internal sealed class ClampFrames
    {
        private readonly RodSchedule _schedule;
        private readonly Func<string?> _solve;
        private double _proximal;  // turn that has been made, radians
        private double _distal;
        private double _time;      // up to which motions of the ends have been made, s

        /// <summary>Frames that have made no turn yet.</summary>
        /// <param name="solve">Solves a part, and says why it has no solution.</param>
        public ClampFrames(RodSchedule schedule, Func<string?> solve)
        {
            _schedule = schedule;
            _solve = solve;
        }

        /// <summary>The turns that the frames have made, radians.</summary>
        public (double Proximal, double Distal) Made
        {
            get => (_proximal, _distal);
            set => (_proximal, _distal) = value;
        }

        /// <summary>The distal frame has already made its turn of time 0.</summary>
        public void Begin() => _distal = _schedule.Distal.TurnAt(0.0);

        /// <summary>Whether the frames are where they should be at this time, to within an angle.</summary>
        public bool AreInPlace(double time, double angle)
        {
            return Math.Abs(_schedule.Hub.FrameTurnAt(time) - _proximal) <= angle
                && Math.Abs(_schedule.Distal.TurnAt(time) - _distal) <= angle
                && _schedule.AngleBetween(_time, time) <= angle;
        }

        /// <summary>Turns the frames of a shape.</summary>
        /// <param name="inParts">Whether it took parts: all but the last are then solved.</param>
        /// <returns>Null, or why a part has no solution.</returns>
        public string? Turn(RodShape shape, double time, out bool inParts)
        {
            inParts = false;
            double proximal = _schedule.Hub.FrameTurnAt(time) - _proximal;
            double distal = _schedule.Distal.TurnAt(time) - _distal;
            double rotation = _schedule.AngleBetween(_time, time);
            if (proximal == 0.0 && distal == 0.0 && rotation == 0.0)
            {
                _time = time;
                return null;
            }
            string? failure = Winding.Split(
                Math.Max(Math.Max(Math.Abs(proximal), Math.Abs(distal)), rotation), out int parts);
            if (failure != null)
            {
                return failure;
            }
            inParts = parts > 1;
            for (int k = 1; k <= parts; k++)
            {
                double fraction = (double)k / parts;
                _schedule.TurnFrames(shape, _proximal + fraction * proximal, _distal + fraction * distal,
                    k < parts ? _time + fraction * (time - _time) : time);
                if (k < parts)
                {
                    failure = _solve();
                    if (failure != null)
                    {
                        return failure;
                    }
                }
            }
            _proximal += proximal;
            _distal += distal;
            _time = time;
            return null;
        }

        /// <summary>Up to when motions of the ends have been made, s.</summary>
        public double Time
        {
            get => _time;
            set => _time = value;
        }

        /// <summary>Writes or restores the turns; for a step also their time.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(ref _proximal);
            snapshot.Serialize(ref _distal);
            if (snapshot.IsStep)
            {
                Time = snapshot.Serialize(Time);
            }
        }
    }

    /// <summary>Divides a sudden rotation of a clamp into increments, each solved before the next, so that a rod is
    /// wound up instead of rotating through the smaller angle.</summary>
    internal static class Winding
    {
        private const double LargestTurn = 0.5;   // radians a part
        private const double MaxTurn = 10_000.0; // radians that are wound up at once at all

        /// <summary>Into how many parts a turn is split.</summary>
        /// <param name="turn">Radians.</param>
        /// <param name="parts">At least 1; of no use with a failure.</param>
        /// <returns>Null, or why it cannot be wound up.</returns>
        public static string? Split(double turn, out int parts)
        {
            double size = Math.Abs(turn);
            if (!(size <= MaxTurn))
            {
                parts = 0;
                return "a clamp turns by more than " + MaxTurn + " rad at once (distalRotation, twistPerStep)";
            }
            parts = 1 + (int)(size / LargestTurn);
            return null;
        }
    }
}
