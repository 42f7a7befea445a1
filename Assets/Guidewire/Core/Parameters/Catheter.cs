using System;

namespace Guidewire.Core
{
    /// <summary>A catheter over the wire: an instrument of its own, fed and turned at its own hub, on the wire's axis
    /// at its start.</summary>
    public sealed class Catheter
    {
        /// <summary>The catheter's length L, units.</summary>
        public double Length { get; set; }

        /// <summary>The number of its elements n.</summary>
        public int Elements { get; set; } = 30;

        /// <summary>Distance of its hub ahead of the wire's at the start, units.</summary>
        public double Start { get; set; }

        /// <summary>Coefficient of friction of its outside with all walls; NaN: those of the walls.</summary>
        public double FrictionCoefficient { get; set; } = double.NaN;

        /// <summary>Coefficient of friction between the wire and its lumen, along the axis; 0: none.</summary>
        public double LumenFriction { get; set; }

        /// <summary>Force on its tip, N.</summary>
        public Vector3d TipForce { get; set; }

        /// <summary>Force per length at rest, N/m.</summary>
        public Vector3d DistributedForce { get; set; }

        /// <summary>Forces at lengths from its hub, units.</summary>
        public PointLoad[] PointLoads { get; set; } = Array.Empty<PointLoad>();

        /// <summary>What it is made of; <see cref="MaterialParameters.InnerRadius"/> is that of its lumen.</summary>
        public MaterialParameters Material { get; set; } = new MaterialParameters();

        /// <summary>What moves its hub; along the wire's axis.</summary>
        public DriveParameters Drive { get; set; } = new DriveParameters();
    }
}
