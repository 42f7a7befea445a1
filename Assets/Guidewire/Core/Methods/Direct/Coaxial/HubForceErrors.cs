using System;

namespace Guidewire.Core
{
    /// <summary>How far the forces of several hubs are uncertain, because elements are long for the bend of an
    /// instrument beyond the tip around it.</summary>
    /// <remarks>Its force f at that tip bends an instrument over a length sqrt(B/f). Where elements are not much
    /// shorter, walls hand it from node to node, and each hub's force ripples about its mean. The sum of all does not.
    /// <see cref="Release.SmoothForce"/> ripples less, and the root mean square of the difference over all steps is the
    /// error.</remarks>
    internal sealed class HubForceErrors
    {
        /// <summary>Fraction of the largest force of any hub, from which on a warning is due.</summary>
        public const double LargeError = 0.05;

        /// <summary>Error below which nothing is said, N: a tenth of the least force that a hand feels.</summary>
        public const double SmallError = 1e-4;

        /// <summary>The same of l sqrt(f/B).</summary>
        public const double LargeElement = 0.5;

        private readonly double[] _squares;     // sum of the squares of differences by hub, N^2
        private readonly double[] _length;      // sum of l^2 f/B by hub
        private double _peak;                   // of any hub, N
        private int _steps;

        /// <summary>Of so many hubs.</summary>
        public HubForceErrors(int count)
        {
            _squares = new double[count];
            _length = new double[count];
        }

        /// <summary>Gives the error of the force of a hub, N: of the outermost one first.</summary>
        public double Of(int hub) => _steps == 0 ? 0.0 : Math.Sqrt(_squares[hub] / _steps);

        /// <summary>Gives l sqrt(f/B) of the element at the tip around an instrument.</summary>
        public double ElementOf(int hub) => _steps == 0 ? 0.0 : Math.Sqrt(_length[hub] / _steps);

        /// <summary>Takes the end of a step.</summary>
        public void AddStep(RodDynamics dynamics, CoaxialJoints joints, double outermost)
        {
            RodTerms terms = dynamics.Terms;
            RodShape shape = dynamics.Shape;
            Release release = terms.Release!;
            AxialForces axial = terms.Supports.Coaxial!.Axial;
            double sum = 0.0;
            for (int i = 1; i < joints.Count; i++)
            {
                double smooth = release.SmoothForce(shape, terms, i);
                double apart = release.InnerForce(shape, terms, i) - smooth;
                sum += apart;
                _squares[i] += apart * apart;
                _peak = Math.Max(_peak, Math.Abs(smooth));
                int tip = joints.TipOf(i - 1);
                if (joints.BeyondOf(i) > 1)
                {
                    double length = joints.Stations[tip + 2] - joints.Stations[tip + 1];
                    _length[i] += length * length * Math.Abs(axial.BorneAt(tip))
                        / joints.PieceAt(tip + 1, i).BendStiffness1;
                }
            }
            _squares[0] += sum * sum;
            _peak = Math.Max(_peak, Math.Abs(outermost - sum));
            _steps++;
        }

        /// <summary>That the force of a hub is not what it would be with shorter elements, or null.</summary>
        /// <param name="name">What the warning calls the hub.</param>
        public RunWarning? FindWarning(int hub, string name)
        {
            return Of(hub) <= System.Math.Max(SmallError, LargeError * _peak) && ElementOf(hub) <= LargeElement
                ? (RunWarning?)null
                : WarningTable.HubForceError.With(name, Of(hub), _peak, ElementOf(hub));
        }

        /// <summary>Writes or restores all of it.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(_squares);
            snapshot.Serialize(_length);
            snapshot.Serialize(ref _peak);
            snapshot.Serialize(ref _steps);
        }
    }
}
