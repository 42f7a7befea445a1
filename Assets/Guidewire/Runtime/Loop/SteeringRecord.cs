using System;
using System.Collections.Generic;
using Guidewire.Io;

namespace Guidewire.Runtime
{
    /// <summary>What a run was commanded, by step: with the same record it has the same bits again, whoever makes its
    /// steps and however fast.</summary>
    /// <remarks>Only what changes is kept, in lists that grow by whole blocks.</remarks>
    public sealed class SteeringRecord
    {
        private const int Block = 4096;

        private readonly List<(int Step, int Entry, double Speed)> _speeds =
            new List<(int Step, int Entry, double Speed)>(Block);

        private readonly List<(int Step, Action<SimulationSession> Change)> _changes =
            new List<(int Step, Action<SimulationSession> Change)>();

        private readonly double[] _last = new double[2 * HubCommands.Most];
        private int _steps;
        private int _speed;    // places up to which it was played
        private int _change;

        /// <summary>How many changes of the hubs' speeds it holds.</summary>
        public int Count => _speeds.Count;

        /// <summary>The session that is recorded; null before the run is open.</summary>
        internal SimulationSession? Session { get; set; }

        /// <summary>The motion of a hub as a table for the key <c>driveFile</c>: time, insertion and rotation in s, m
        /// and rad. A run that it drives has the same bits.</summary>
        /// <param name="instrument">0 the wire, k catheter k.</param>
        /// <exception cref="InvalidOperationException">No table says it, as where parameters were changed in the
        /// run.</exception>
        public string ToDriveTable(int instrument = 0)
        {
            try
            {
                return (Session ?? throw new InvalidOperationException("no run is open")).DriveTable(instrument);
            }
            catch (ParameterException error)
            {
                throw new InvalidOperationException(error.Message);
            }
        }

        internal void Add(int step, double[] speeds)
        {
            _steps = step + 1;
            for (int entry = 0; entry < speeds.Length; entry++)
            {
                if (speeds[entry] != _last[entry])
                {
                    if (_speeds.Count == _speeds.Capacity)
                    {
                        _speeds.Capacity += Block;
                    }
                    _speeds.Add((step, entry, speeds[entry]));
                    _last[entry] = speeds[entry];
                }
            }
        }

        internal void Add(int step, Action<SimulationSession> change) => _changes.Add((step, change));

        /// <summary>Begins to play it.</summary>
        internal void Rewind()
        {
            (_speed, _change) = (0, 0);
        }

        /// <summary>Writes the speeds of a step; steps are asked for in their order, from 0 on.</summary>
        internal void Read(int step, double[] speeds)
        {
            if (_speed == 0)
            {
                Array.Clear(speeds, 0, speeds.Length);
            }
            for (; _speed < _speeds.Count && _speeds[_speed].Step <= step; _speed++)
            {
                speeds[_speeds[_speed].Entry] = _speeds[_speed].Speed;
            }
            if (step >= _steps)
            {
                Array.Clear(speeds, 0, speeds.Length);    // it is over: the hubs rest
            }
        }

        /// <summary>Gives the next change before a step, or null.</summary>
        internal Action<SimulationSession>? ChangeAt(int step) =>
            _change < _changes.Count && _changes[_change].Step <= step ? _changes[_change++].Change : null;
    }
}
