using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>What a run with a material is told beyond the seed's values, in SI units but for lengths along the wire
    /// and displacements, which are in units of <see cref="MetresPerUnit"/>. A run with gains takes its ends from here
    /// too.</summary>
    public sealed class MaterialParameters
    {
        /// <summary>E, Pa.</summary>
        public double YoungsModulus { get; set; } = 60e9;

        /// <summary>G, Pa.</summary>
        public double ShearModulus { get; set; } = 23e9;

        /// <summary>rho, kg/m^3.</summary>
        public double Density { get; set; } = 6450.0;

        /// <summary>Radius of the wire, m.</summary>
        public double WireRadius { get; set; } = 0.5e-3;

        /// <summary>Curvature about d1 and d2 and twist about d3 at rest, rad/m.</summary>
        public Vector3d RestCurvature { get; set; }

        /// <summary>Pieces of the wire that differ from the rest; later ones count where they overlap.</summary>
        public IReadOnlyList<WireSection> Sections { get; set; } = Array.Empty<WireSection>();

        /// <summary>Length of one unit, m.</summary>
        public double MetresPerUnit { get; set; } = 1e-3;

        /// <summary>Force on the last sphere, N.</summary>
        public Vector3d TipForce { get; set; }

        /// <summary>When the tip force ends, s; it acts up to and including this time.</summary>
        public double TipForceReleaseTime { get; set; } = 1e9;

        /// <summary>Couple at the wire's end along the axes there, N m: it turns with them.</summary>
        public Vector3d TipMoment { get; set; }

        /// <summary>How the run starts.</summary>
        public InitialState InitialState { get; set; } = InitialState.Straight;

        /// <summary>The shape it sets out from.</summary>
        public StartShape StartShape { get; set; } = StartShape.Straight;

        /// <summary>Radius of a helix to start from, units.</summary>
        public double StartRadius { get; set; } = 10.0;

        /// <summary>Turns of a helix to start from.</summary>
        public double StartTurns { get; set; } = 1.0;

        /// <summary>What holds the proximal end; a drive that moves sphere 0 needs it held or clamped.</summary>
        public ProximalEnd ProximalEnd { get; set; } = ProximalEnd.Held;

        /// <summary>What holds the distal end.</summary>
        public DistalEnd DistalEnd { get; set; } = DistalEnd.Free;

        /// <summary>Force along the axis of a sliding distal end, N; a pull is positive.</summary>
        public double AxialForce { get; set; }

        /// <summary>Turn of the distal frame about its own d3, radians; more than one turn counts.</summary>
        public double DistalRotation { get; set; }

        /// <summary>Displacement of the distal end along its frame's d3, units.</summary>
        public double DistalDisplacement { get; set; }

        /// <summary>Time over which rotation and displacement of the distal end grow, s; 0: at once.</summary>
        public double DistalRampTime { get; set; }

        /// <summary>Weights of the joints at a clamp.</summary>
        public ClampRule ClampRule { get; set; } = ClampRule.FourthOrder;

        /// <summary>The mass matrix.</summary>
        public MassRule MassRule { get; set; } = MassRule.Consistent;

        /// <summary>The law of a joint.</summary>
        public BendLaw BendLaw { get; set; } = BendLaw.RotationVector;

        /// <summary>Parts into which the explicit and the compliant solver divide a time step.</summary>
        public int Substeps { get; set; } = 1;

        /// <summary>Error that a solver may leave in a step: radians, or displacement over L; of the direct solver also
        /// what it may leave of the balance of forces, over the largest force in the wire.</summary>
        public double SolverTolerance { get; set; } = 1e-6;

        /// <summary>Newton iterations after which the direct solver gives up a stage; a rest shape gets ten times as
        /// many. </summary>
        public int MaxNewtonIterations { get; set; } = 50;

        /// <summary>The same values; lists are shared.</summary>
        internal MaterialParameters Copy()
        {
            return (MaterialParameters)MemberwiseClone();
        }
    }
}
