using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>What quantities of a run are read off: its state after a step, and records that are made once for all
    /// quantities.</summary>
    internal sealed class Moment
    {
        private readonly double[] _numbers = new double[4];
        private Simulation? _simulation;
        private StressRecord? _stress;
        private HubRecord? _hub;
        private IReadOnlyList<CoaxialRecord>? _catheters;

        /// <summary>The run.</summary>
        public Simulation Simulation => _simulation!;

        /// <summary>Its wire.</summary>
        public RodState State => Simulation.State;

        /// <summary>The strains of a wire with a material, else null.</summary>
        public StressRecord? Stress => _stress ??= Simulation.Stress();

        /// <summary>What is read off at hub and tip; null where the method does not have it.</summary>
        public HubRecord? Hub => _hub ??= Simulation.Hub();

        /// <summary>The contacts with walls, or null.</summary>
        public ContactRecord? Contacts => Simulation.Contacts;

        /// <summary>The catheters, outermost first.</summary>
        public IReadOnlyList<CoaxialRecord> Catheters => _catheters ??= Simulation.Catheters();

        /// <summary>The index of the catheter whose quantities are read.</summary>
        public int CatheterIndex { get; set; }

        /// <summary>The catheter whose quantities are read.</summary>
        public CoaxialRecord Catheter => Catheters[CatheterIndex];

        /// <summary>The place in the vessel of the instrument whose quantities are read, or null.</summary>
        public LumenPlace? Lumen { get; set; }

        /// <summary>Wall time since the start of the run, ms.</summary>
        public double Elapsed { get; private set; }

        /// <summary>The first sphere that the log has.</summary>
        public int FirstSphere { get; private set; }

        /// <summary>Goes on to a state; what was read of another one is no longer valid.</summary>
        public void GoTo(Simulation simulation, double elapsed = 0.0, int firstSphere = 0)
        {
            _simulation = simulation;
            _stress = null;
            _hub = null;
            _catheters = null;
            Elapsed = elapsed;
            FirstSphere = firstSphere;
        }

        /// <summary>Gives one number; none where it is null.</summary>
        public ReadOnlySpan<double> Of(double? value)
        {
            _numbers[0] = value ?? 0.0;
            return _numbers.AsSpan(0, value.HasValue ? 1 : 0);
        }

        /// <summary>Gives the three numbers of a vector; none where it is null.</summary>
        public ReadOnlySpan<double> Of(Vector3d? value)
        {
            if (!(value is Vector3d vector))
            {
                return default;
            }
            _numbers[0] = vector.X;
            _numbers[1] = vector.Y;
            _numbers[2] = vector.Z;
            return _numbers.AsSpan(0, 3);
        }

        /// <summary>Gives the numbers of vectors.</summary>
        public static ReadOnlySpan<double> Of(Vector3d[]? vectors) => MemoryMarshal.Cast<Vector3d, double>(vectors);

        /// <summary>Gives the numbers x, y, z, w of quaternions.</summary>
        public static ReadOnlySpan<double> Of(Quaterniond[] quaternions) =>
            MemoryMarshal.Cast<Quaterniond, double>(quaternions);
    }
}
