using System;

namespace Guidewire.Core
{
    /// <summary>The hubs of coaxial instruments, which move along one axis.</summary>
    internal sealed class CoaxialHubs
    {
        private readonly Vector3d _axis;
        private readonly SheathEnd? _sheath;
        private readonly HubMotion[] _hub;

        /// <summary>Holds these hubs.</summary>
        /// <param name="hubs">That of the outermost instrument first.</param>
        /// <param name="axis">A unit vector.</param>
        /// <param name="sheath">In which they are, or null.</param>
        public CoaxialHubs(HubMotion[] hubs, in Vector3d axis, SheathEnd? sheath)
        {
            _hub = hubs;
            _sheath = sheath;
            _axis = axis;
            Inner = new HubMotion[hubs.Length - 1];
            Array.Copy(hubs, 1, Inner, 0, Inner.Length);
        }

        /// <summary>That of the outermost instrument.</summary>
        public HubMotion Outer => _hub[0];

        /// <summary>Those of the others.</summary>
        public HubMotion[] Inner { get; }

        /// <summary>Gives the distance of one behind the outermost one at a time, m.</summary>
        public double LeadAt(int instrument, double time) =>
            Vector3d.Dot(_hub[0].PositionAt(time) - _hub[instrument].PositionAt(time), _axis);

        /// <summary>Sets the distance of all behind the outermost one at a time, m.</summary>
        public void SetLeads(double[] leads, double time)
        {
            for (int i = 1; i < leads.Length; i++)
            {
                leads[i] = LeadAt(i, time);
            }
        }

        /// <summary>Gives the axial speed of one relative to another, m/s.</summary>
        public double SlideOf(int instrument, int other) =>
            Vector3d.Dot(_hub[instrument].Velocity - _hub[other].Velocity, _axis);

        /// <summary>Gives the distance of the outermost one from the exit of a sheath at a time, m; 0 without
        /// one.</summary>
        public double SheathedAt(double time) =>
            _sheath == null ? 0.0 : Math.Max(0.0, -_sheath.Outside(Outer.PositionAt(time)));

        /// <summary>Turn of an element of the outermost instrument against its hub's frame at time 0, radians: all
        /// turns of the joints before it.</summary>
        public double TurnAt(RodShape outermost, int element)
        {
            double turn = Outer.TurnAt(0.0);
            Quaterniond frame = Outer.FrameTurned(turn);
            for (int j = 0; j < element; j++)
            {
                turn += RotationVector.Log(frame.Conjugate * outermost.Q[j]).Z;
                frame = outermost.Q[j];
            }
            return turn;
        }

        /// <summary>Gives the rotation of one relative to the outermost one, radians.</summary>
        public double TwistAt(int instrument, double time) => _hub[instrument].TurnAt(time) - _hub[0].TurnAt(time);
    }

    /// <summary>How fast instruments and the exit of a sheath move along a chain, over the speed of the hub by whose
    /// position a derivative is.</summary>
    internal sealed class HubSpeeds
    {
        /// <summary>The speeds of so many instruments, all of them 0.</summary>
        public HubSpeeds(int count)
        {
            Instruments = new double[count];
        }

        /// <summary>The speed of each instrument.</summary>
        public double[] Instruments { get; }

        /// <summary>The speed of the exit.</summary>
        public double Exit { get; set; }
    }

    /// <summary>Where instruments and the sheath around them are along a chain.</summary>
    internal sealed class HubPlaces
    {
        private const double Rounding = 1e-14;    // of a length
        /// <summary>The places of so many instruments, all hubs in one.</summary>
        public HubPlaces(int count)
        {
            Leads = new double[count];
            Ends = new double[count];
        }

        /// <summary>How far each hub is behind the outermost one's, m.</summary>
        public double[] Leads { get; }

        /// <summary>Where the instruments end, m from the outermost hub.</summary>
        public double[] Ends { get; }

        /// <summary>Sets where an instrument ends, m. A tip that only rounding takes from the outer instrument's last
        /// node is there, so that rounding does not choose the side of it.</summary>
        /// <param name="node">That node, m from the outermost hub.</param>
        public void SetEnd(int instrument, double end, double node) =>
            Ends[instrument] = Math.Abs(end - node) <= Rounding * node ? node : end;

        /// <summary>Where the sheath ends, m from the outermost hub.</summary>
        public double Sheathed { get; set; }

        /// <summary>The fraction of what joint k of a chain stands for, weighted by its hat function, that is not in
        /// the sheath.</summary>
        /// <param name="station">Of the nodes, m from the outermost hub.</param>
        /// <param name="last">Of them.</param>
        public double FractionOutside(int k, double[] station, int last)
        {
            double node = station[k];
            if (Sheathed <= (k > 0 ? station[k - 1] : node))
            {
                return 1.0;
            }
            double before = k > 0 ? node - station[k - 1] : 0.0;
            double after = k < last ? station[k + 1] - node : 0.0;
            double beyond = Sheathed < node ? after + (node - Sheathed) * (1.0 + (Sheathed - node + before) / before)
                : after > 0.0 ? Math.Pow(Math.Max(0.0, node + after - Sheathed), 2.0) / after : 0.0;
            return beyond / (before + after);
        }
    }

    /// <summary>Axial Coulomb friction between an instrument and the lumen around it, as a force at its hub.</summary>
    /// <remarks>Where a force T passes along the inner instrument it lies against the lumen with |T kappa| per length,
    /// and with P = 2 B_r dk/a at each end of the overlap, a = sqrt(12 play/dk). So as it slides its force changes by
    /// mu P at either end and by dT/ds = mu |T kappa| between. With theta the angle of the overlap and F the hub's
    /// force without friction, pushed on it has
    /// <code>t = F + mu P,  U(F) = t exp(sign(t) mu theta) + mu P</code>
    /// and drawn back -U(-F). At rest the hub's force is anywhere between the two: the part that is used is the slip
    /// since the sense has changed over an elastic slip, as of contacts with walls.
    ///
    /// With several instruments inside, T and F are their sums, whatever passes between them: the next one inside has
    /// what this lumen adds, and the one around loses it.
    ///
    /// P is that of the largest difference of the two rest curvatures, at both ends: a bound. Friction about the axis
    /// is left out, and so is that the shape feels what friction takes from the force along the overlap.</remarks>
    internal sealed class LumenFriction
    {
        private readonly double _elasticSlip;  // m
        private double _used;                  // of what may be held, 1: pushed on, -1: drawn back

        /// <summary>Nothing has slid so far.</summary>
        /// <param name="coefficient">mu; 0: none.</param>
        /// <param name="elasticSlip">m.</param>
        public LumenFriction(double coefficient, double elasticSlip)
        {
            Coefficient = coefficient;
            _elasticSlip = elasticSlip;
        }

        /// <summary>The coefficient mu.</summary>
        public double Coefficient { get; }

        /// <summary>The inner instrument has slid.</summary>
        /// <param name="slide">Towards its tip against the outer one, m.</param>
        public void Slide(double slide) => _used = Math.Max(-1.0, Math.Min(1.0, _used + slide / _elasticSlip));

        /// <summary>What the hub has to push with in addition to its force without friction, N.</summary>
        /// <param name="force">The latter, N, a thrust positive.</param>
        /// <param name="angle">Of the overlap, rad.</param>
        /// <param name="end">P, N.</param>
        public double Force(double force, double angle, double end)
        {
            return Coefficient == 0.0 || _used == 0.0 ? 0.0
                : _used > 0.0 ? _used * (Pushed(force, angle, end) - force)
                : _used * (Pushed(-force, angle, end) + force);
        }

        /// <summary>Writes or restores what is used.</summary>
        public void Serialize(Snapshot snapshot)
        {
            if (Coefficient > 0.0)
            {
                snapshot.Serialize(ref _used);
            }
        }

        private double Pushed(double force, double angle, double end)
        {
            double t = force + Coefficient * end;
            return t * Math.Exp(Math.Sign(t) * Coefficient * angle) + Coefficient * end;
        }
    }
}
