using System;

namespace Guidewire.Core
{
    /// <summary>Prescribes the motion of node 0 of a material rod and the turn of its clamp within the next step, from
    /// user steering, a table or the drive's speeds.</summary>
    internal sealed class MaterialDrive
    {
        private const double Nothing = 1e-12;  // m, a displacement left by rounding of times in a table

        private readonly IDriveDirection? _direction;
        private readonly double _speed;      // m/s
        private readonly double _timeStep;   // s
        private readonly double _metres;     // per unit
        private readonly Steering? _steering;
        private readonly DriveTable? _table;
        private readonly bool _followsSpring;
        private double _minInsertion = double.NegativeInfinity;  // m
        private double _maxInsertion = double.PositiveInfinity;   // m
        private double? _override;           // of the next step, m
        private MaterialDrive? _behind;      // of the hubs that may press on this one
        private MaterialDrive? _ahead;
        private Func<double, double>? _gap;  // m, from the one behind to this at a time, s
        private readonly double _length;     // of the instrument, m
        private double _sense = 1.0;         // 1 where it was last asked to push, -1 to pull
        private double _insertionBefore;     // the present step, m
        private double _turnBefore;          // the same, rad
        private double _carriedBy;           // of the present step, what another hub makes of it, m

        /// <summary>Makes the drive of this scene.</summary>
        /// <param name="followsSpring">Whether node 0 follows its support on a spring, which yields a little.</param>
        public MaterialDrive(SimulationParameters parameters, Scene scene, bool followsSpring)
        {
            DriveParameters drive = parameters.Drive;
            _followsSpring = followsSpring;
            Hub = scene.Schedule.Hub;
            _timeStep = parameters.Method.TimeStep;
            _metres = scene.UnitLength;
            _length = scene.UnitLength * parameters.Scene.GuidewireLength;
            LargestSlip = drive.LargestSlip(parameters.Method.TimeStep);
            _speed = drive.InsertionSpeed != 0.0 ? drive.InsertionSpeed
                : scene.UnitLength * drive.DisplacementPerStep / parameters.Method.TimeStep;
            _steering = scene.Steering;
            _table = _steering == null ? drive.Table : null;
            _direction = _steering == null ? scene.Drive : scene.Drive ?? new AlongFirstElement();
            if (_steering != null || _table != null)
            {
                Hub.BeginDrive(_table?.End ?? double.PositiveInfinity);
            }
        }

        /// <summary>The drive of a wire in a sheath, as far as it has come, on another hub's motion.</summary>
        /// <param name="axis">Direction of the sheath.</param>
        public MaterialDrive(MaterialDrive drive, HubMotion hub, in Vector3d axis)
        {
            Hub = hub;
            _direction = drive._direction == null ? null : new FixedAxis(axis);
            _speed = drive._speed;
            _timeStep = drive._timeStep;
            _metres = drive._metres;
            _length = drive._length;
            LargestSlip = drive.LargestSlip;
            _steering = drive._steering;
            _table = drive._table;
            _followsSpring = true;
            _minInsertion = drive._minInsertion;
            _maxInsertion = drive._maxInsertion;
            var kept = new Snapshot(isStep: true);
            drive.Serialize(kept);
            Serialize(kept.ToRead());
        }

        /// <summary>How far the hub goes in a step where it slips, m, as far as that is not asked.</summary>
        public double LargestSlip { get; }

        /// <summary>The hub that it moves.</summary>
        public HubMotion Hub { get; }

        /// <summary>Displacement of node 0 by the drive along its direction since the start, m; negative where it has
        /// pulled.</summary>
        public double Insertion { get; private set; }

        /// <summary>Rotation of the clamp by the drive since the start, rad.</summary>
        public double Turn { get; private set; }

        /// <summary>How far node 0 goes in the present step, m.</summary>
        public double Moved => Insertion - _insertionBefore;

        /// <summary>What its own drive makes of that, in the sense in which it was last asked to go, m.</summary>
        public double Progress => _sense * (Moved - _carriedBy);

        /// <summary>By how much more the hub goes in the present step than its own drive asks, m: carried by
        /// another.</summary>
        public double CarriedBy => Math.Abs(_carriedBy);

        /// <summary>By how much the clamp turns in the present step, rad.</summary>
        public double Turned => Turn - _turnBefore;

        /// <summary>Direction of the drive in the present step, a unit vector; zero where nothing is driven.</summary>
        public Vector3d Axis { get; private set; }

        /// <summary>Displacement that the hub has lost, m: less where it slipped in the sense in which it was asked to
        /// go.</summary>
        public double Slip { get; private set; }

        /// <summary>When the present step ends, s.</summary>
        public double StepEnd { get; private set; }

        /// <summary>The displacement that its own drive asks for in the present step, m, never negative.</summary>
        public double CommandedDisplacement { get; private set; }

        /// <summary>The displacement asked for in all steps, m, there and back both counted.</summary>
        public double TotalCommandedDisplacement { get; private set; }

        /// <summary>Whether so much was lost that the hub has not done what it was asked.</summary>
        public bool FallsShort => Shortfall.Counts(Slip, TotalCommandedDisplacement, _length);

        /// <summary>1 where the hub behind carries this one along in the present step, -1 where that ahead does, else
        /// 0.</summary>
        public int Carried => Math.Sign(_carriedBy);

        /// <summary>Distance of node 0 beyond the largest displacement allowed, m; negative if it is within.</summary>
        public double BeyondLimit => Insertion - _maxInsertion;

        /// <summary>The hub had come so far before the run, m and radians.</summary>
        public void BeginAt(double insertion, double turn)
        {
            Insertion = insertion;
            Turn = turn;
        }

        /// <summary>Sets the largest displacements of node 0 from its present position, m.</summary>
        /// <param name="back">0 or less.</param>
        /// <param name="forward">0 or more.</param>
        public void Limit(double back, double forward)
        {
            _minInsertion = Math.Min(Insertion, Insertion + back);
            _maxInsertion = Insertion + forward;
        }

        /// <summary>Lets this hub and the one behind carry one another along where one is pressed against the other,
        /// whose own drive does not go the other way.</summary>
        /// <param name="gap">From that hub to this one at a time (s), m.</param>
        public void LetPress(MaterialDrive behind, Func<double, double> gap) =>
            (_behind, _gap, behind._ahead) = (behind, gap, this);

        /// <summary>Displacement of node 0 in the following steps, m, instead of that asked; null: as asked.</summary>
        public void OverrideDisplacement(double? displacement) => _override = displacement;

        /// <summary>Sets where node 0 is and how fast it goes and turns, from this time on.</summary>
        public void Prepare(RodShape shape, double time)
        {
            (_insertionBefore, _turnBefore) = (Insertion, Turn);
            if (_steering != null)
            {
                Hub.TurnOn(time, _steering.Turn / _timeStep);
            }
            else if (_table != null)
            {
                Hub.TurnOn(time, Rate(_table.Rotation, time));
            }
            StepEnd = time + _timeStep;
            Turn = Hub.TurnAt(StepEnd);
            if (_direction == null)
            {
                return;
            }
            double speed = SpeedAt(time);
            double own = speed * _timeStep;
            double asked = AskedAt(time);
            _sense = Math.Abs(asked) < Nothing ? _sense : Math.Sign(asked);
            CommandedDisplacement = Math.Abs(own);
            TotalCommandedDisplacement += CommandedDisplacement;
            double goes = Limited(_override ?? asked);
            _carriedBy = (goes - own) * (asked - own) > 0.0 ? goes - own : 0.0;
            if (goes != own)
            {
                Slip += _sense * (own - goes + _carriedBy);
                speed = goes / _timeStep;
            }
            Axis = _direction.At(shape.X[0], shape.X[1]);
            Hub.MoveOn(time, _followsSpring ? Hub.PositionAt(time) : shape.X[0], speed * Axis);
            Insertion += speed * _timeStep;
        }

        /// <summary>Displacement that is asked of node 0 in the step that begins at this time, by its own drive or by
        /// the hub that carries it, m.</summary>
        public double AskedAt(double time)
        {
            double pushed = PushedAt(time);
            return pushed > 0.0 ? pushed : PulledAt(time);
        }

        /// <summary>Displacement of node 0 in the step that begins at this time, m.</summary>
        public double NextMove(double time) => _direction == null ? 0.0 : Limited(_override ?? AskedAt(time));

        /// <summary>Lets the hub slip, after a step, along its axis.</summary>
        /// <param name="slip">m, back where it is positive.</param>
        public void SlipHub(double slip)
        {
            if (slip != 0.0)
            {
                Hub.Shift(-slip * Axis);
                Insertion -= slip;
                Slip += _sense * slip;
            }
        }

        /// <summary>The part of a displacement between two positions in the sense in which the drive was last asked to
        /// go, m.</summary>
        public double AxialProgress(in Vector3d from, in Vector3d to) => _sense * Vector3d.Dot(to - from, Axis);

        /// <summary>Writes or restores how far the hub has come; for a step also what it prescribes.</summary>
        public void Serialize(Snapshot snapshot)
        {
            Insertion = snapshot.Serialize(Insertion);
            Turn = snapshot.Serialize(Turn);
            Slip = snapshot.Serialize(Slip);
            TotalCommandedDisplacement = snapshot.Serialize(TotalCommandedDisplacement);
            snapshot.Serialize(ref _sense);
            if (snapshot.IsStep)
            {
                Axis = snapshot.Serialize(Axis);
                CommandedDisplacement = snapshot.Serialize(CommandedDisplacement);
                StepEnd = snapshot.Serialize(StepEnd);
            }
        }

        // Speed asked for from this time on, m/s.
        private double SpeedAt(double time)
        {
            return _steering != null ? _metres * _steering.Push / _timeStep
                : _table != null ? Rate(_table.Insertion, time) : _speed;
        }

        // The part of a move that the limits allow, m.
        private double Limited(double asked)
        {
            return Insertion + asked > _maxInsertion || Insertion + asked < _minInsertion
                ? Math.Min(Math.Max(Insertion + asked, _minInsertion), _maxInsertion) - Insertion : asked;
        }

        private double OwnAt(double time) => _direction == null ? 0.0 : SpeedAt(time) * _timeStep;

        // What it is asked where the drives of those behind it press on it, m. What slips presses on none.
        private double PushedAt(double time)
        {
            double own = OwnAt(time);
            return _behind == null || _direction == null || own < 0.0 ? own
                : Math.Max(own, Math.Min(_behind._override ?? double.PositiveInfinity, _behind.PushedAt(time))
                    - _gap!(time));
        }

        // The same of those ahead, which draw back.
        private double PulledAt(double time)
        {
            double own = OwnAt(time);
            return _ahead == null || _direction == null || own > 0.0 ? own
                : Math.Min(own, Math.Max(_ahead._override ?? double.NegativeInfinity, _ahead.PulledAt(time))
                    + _ahead._gap!(time));
        }

        private double Rate(TimeTable table, double time) => (table.At(time + _timeStep) - table.At(time)) / _timeStep;
    }
}
