using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>The parts of a session's state, each read off at once, in the order in which an answer has
    /// them.</summary>
    internal enum StatePart
    {
        /// <summary>Positions, orientations, their rates, contact forces and the support's.</summary>
        Motion,

        /// <summary>The hub, and the catheters.</summary>
        Instruments,

        /// <summary>Strains, the forces and couples in the wire, and its energies.</summary>
        Strains,
    }

    /// <summary>What an entry of a log, or a state, has one row of numbers for.</summary>
    internal enum QuantityPlace
    {
        /// <summary>The run: one row.</summary>
        Run,

        /// <summary>Each of the n + 1 nodes, which pbd calls spheres.</summary>
        Node,

        /// <summary>Each of the n rod elements.</summary>
        Element,

        /// <summary>Each of the n + 1 joints.</summary>
        Joint,

        /// <summary>Each wall of the scene.</summary>
        Wall,

        /// <summary>Each point of a vessel's centreline that is told.</summary>
        Point,
    }

    /// <summary>How a number stands in an array of a log.</summary>
    internal enum QuantityType
    {
        /// <summary>As the format says: 8 or 4 bytes.</summary>
        Real,

        /// <summary>Always 8 bytes.</summary>
        Exact,

        /// <summary>A whole number.</summary>
        Whole,

        /// <summary>1 where it holds, else 0; in no log.</summary>
        Flag,
    }

    /// <summary>How the rows of a quantity stand in a log of format json.</summary>
    internal enum QuantityForm
    {
        /// <summary>A number, or an object with a number for each letter.</summary>
        Value,

        /// <summary>A list of lists of numbers.</summary>
        Rows,

        /// <summary>An object with a row for each index.</summary>
        ByIndex,

        /// <summary>An object with a row for each index whose numbers are not all 0.</summary>
        Nonzero,
    }

    /// <summary>The switch that puts a quantity into logs.</summary>
    internal enum QuantitySwitch
    {
        /// <summary>It is not in logs.</summary>
        Never,

        /// <summary>It is in every log.</summary>
        Always,

        /// <summary>Key logOrientations.</summary>
        Orientations,

        /// <summary>Key logStrains.</summary>
        Strains,

        /// <summary>Key logHub.</summary>
        Hub,

        /// <summary>Key logContacts.</summary>
        Contacts,

        /// <summary>A sheath.</summary>
        Sheath,
    }

    /// <summary>Reads the numbers of a quantity, row by row; none where the run does not have it.</summary>
    internal delegate ReadOnlySpan<double> Reading(Moment moment);

    /// <summary>One quantity of a run at one moment: what it is, and where logs, answers and summaries have it.
    /// </summary>
    internal sealed class Quantity
    {
        /// <param name="name">The name of its array in logs of format npz.</param>
        /// <param name="letters">The names of a row's numbers in logs of format json, separated by blanks.</param>
        public Quantity(string name, QuantityPlace place, string letters, string unit, string help, Reading read)
        {
            Name = name;
            Place = place;
            Letters = letters.Split(' ');
            Unit = unit;
            Help = help;
            Read = read;
            Form = place == QuantityPlace.Run ? QuantityForm.Value : QuantityForm.Rows;
        }

        /// <summary>The name of its array in logs of format npz; of a catheter with "catheter" and a number before it.
        /// </summary>
        public string Name { get; }

        /// <summary>What has a row of it.</summary>
        public QuantityPlace Place { get; }

        /// <summary>The names of a row's numbers in logs of format json.</summary>
        public string[] Letters { get; }

        /// <summary>The unit of a wire with a material; "units" are the scene's unit of length.</summary>
        public string Unit { get; }

        /// <summary>What it is.</summary>
        public string Help { get; }

        /// <summary>Reads it off.</summary>
        public Reading Read { get; }

        /// <summary>How a number stands in an array of a log.</summary>
        public QuantityType Type { get; private set; }

        /// <summary>The switch that puts it into logs.</summary>
        public QuantitySwitch Switch { get; set; }

        /// <summary>The object of summary.json, and of an entry of format json, in which it stands; "": the entry
        /// itself.</summary>
        public string Group { get; private set; } = "";

        /// <summary>Its key in an entry of format json; null: that does not have it.</summary>
        public string? Key { get; private set; }

        /// <summary>How its rows stand there.</summary>
        public QuantityForm Form { get; private set; }

        /// <summary>The array of a session's answer that has it, after the quantities of that array before it; null:
        /// none.</summary>
        public string? Answer { get; private set; }

        /// <summary>The part of a session's state that has it.</summary>
        public StatePart Part { get; private set; }

        /// <summary>Its key in summary.json; null: that does not have it.</summary>
        public string? Summary { get; private set; }

        /// <summary>States how a number stands in an array of a log.</summary>
        public Quantity Typed(QuantityType type)
        {
            Type = type;
            return this;
        }

        /// <summary>States where an entry of format json has it.</summary>
        /// <param name="path">A key, or a group and a key with a point between them.</param>
        /// <param name="form">Null: a number or a list.</param>
        public Quantity Json(string path, QuantityForm? form = null)
        {
            int point = path.IndexOf('.');
            Group = path.Substring(0, Math.Max(0, point));
            Key = path.Substring(point + 1);
            Form = form ?? Form;
            return this;
        }

        /// <summary>States what array of an answer has it.</summary>
        /// <param name="array">Null: one of its own name.</param>
        public Quantity InAnswer(StatePart part, string? array = null)
        {
            Part = part;
            Answer = array ?? Name;
            return this;
        }

        /// <summary>States where summary.json has it.</summary>
        public Quantity InSummary(string group, string key)
        {
            Group = group;
            Summary = key;
            return this;
        }
    }

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
