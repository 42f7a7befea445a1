using System;

namespace Guidewire.Core
{
    /// <summary>Results of the catheters around a wire, the outermost one first, and the forces of all hubs.</summary>
    internal sealed class CatheterRecords
    {
        private readonly CoaxialRecord[] _records;
        private readonly MaterialDrive[] _drives;      // of the outermost catheter first, of the wire last
        private readonly Vector3d _axis;
        private readonly double[] _forces;             // of the hubs without friction, N

        /// <summary>Of the catheters of a setup.</summary>
        public CatheterRecords(CoaxialSetup setup, MaterialDrive[] drives)
        {
            _records = setup.Records();
            _drives = drives;
            _axis = setup.Axis;
            _forces = new double[drives.Length];
            HasFriction = Array.Exists(_records, record => record.FrictionCoefficient > 0.0);
        }

        /// <summary>Whether a lumen has friction.</summary>
        public bool HasFriction { get; }

        /// <summary>The records of all catheters.</summary>
        public CoaxialRecord[] All => _records;

        /// <summary>A step begins, for which the hubs' drives have been prepared.</summary>
        public void BeginStep()
        {
            foreach (CoaxialRecord record in _records)
            {
                record.TakeStep(_drives);
            }
        }

        /// <summary>Takes a moment, at the time that was set last.</summary>
        /// <param name="instruments">The outermost one first.</param>
        public CoaxialRecord Record(RodDynamics dynamics, CoaxialJoints joints, InnerInstrument[] instruments)
        {
            RodTerms terms = dynamics.Terms;
            RodShape shape = dynamics.Shape;
            CoaxialBendTwist bending = terms.CoaxialBending!;
            int wire = _records.Length;
            // The outermost hub has the chain's reaction less those of the others.
            _forces[0] = Vector3d.Dot(dynamics.ReactionAt(0), _axis);
            double torque = Vector3d.Dot(bending.ProximalCouple(shape), _axis);
            double wireTorque = bending.InnerTorque(shape, wire);
            double inside = 0.0;
            for (int i = wire; i > 0; i--)
            {
                _forces[i] = terms.Release!.InnerForce(shape, terms, i);
                _forces[0] -= _forces[i];
                double own = bending.InnerTorque(shape, i);
                torque -= own;
                if (i < wire)
                {
                    _records[i].Record(joints, terms, shape, instruments[i].Shape, _drives[i], _drives[wire], own,
                        wireTorque, inside);
                }
                inside += _forces[i];
            }
            _forces[0] += terms.SheathForce(shape);
            _records[0].Record(joints, terms, shape, instruments[0].Shape, _drives[0], _drives[wire], torque,
                wireTorque, inside);
            double around = 0.0;
            double wireForce = _forces[wire] + _records[wire - 1].FrictionForce;
            for (int i = 0; i < wire; i++)
            {
                _records[i].TakeMotion(instruments[i].Velocities, instruments[i].Spins);
                _records[i].TakeForces(_forces[i], around, wireForce);
                around = _records[i].FrictionForce;
            }
            return _records[0];
        }

        /// <summary>Takes what is left between the instruments.</summary>
        public void TakePlay(CoaxialJoints joints, RodShape shape)
        {
            foreach (CoaxialRecord record in _records)
            {
                record.TakePlay(joints, shape);
            }
        }

        /// <summary>Writes or restores all of it.</summary>
        public void Serialize(Snapshot snapshot)
        {
            foreach (CoaxialRecord record in _records)
            {
                record.Serialize(snapshot);
            }
        }
    }
}
