using System;
using System.Collections.Generic;
using System.Globalization;
using System.Text;
using Guidewire.Core;
using Guidewire.Io;

namespace Guidewire.Runtime
{
    /// <summary>What a run was commanded, by step: with the same record it has the same bits again, whoever makes its
    /// steps and however fast.</summary>
    /// <remarks>Only what changes is kept, in lists that grow by whole blocks.</remarks>
    public sealed class SteeringRecord
    {
        private const int Block = 4096;
        private const double Constant = 1e-6;    // of a step: so long before and after its end the table stands still

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

        /// <summary>The motion of a hub as a table for the key <c>driveFile</c>: time, insertion and rotation in s, m
        /// and rad.</summary>
        /// <param name="parameters">Those of the run.</param>
        /// <param name="instrument">0 the wire, k catheter k.</param>
        /// <exception cref="InvalidOperationException">Parameters were changed in the run, which no table
        /// says.</exception>
        public string ToDriveTable(SimulationParameters parameters, int instrument = 0)
        {
            if (_changes.Count > 0)
            {
                throw new InvalidOperationException("parameters were changed in step " + _changes[0].Step
                    + ": a table holds the motion of a hub alone");
            }
            double dt = parameters.Method.TimeStep;
            double[] speeds = new double[2];
            double[] moved = new double[2];
            var text = new StringBuilder("time,insertion,rotation\n0.0,0.0,0.0\n");
            int next = 0;
            Add(text, Constant * dt, moved);
            for (int step = 0; step < _steps; step++)
            {
                for (; next < _speeds.Count && _speeds[next].Step <= step; next++)
                {
                    int own = _speeds[next].Entry - 2 * instrument;
                    if (own == 0 || own == 1)
                    {
                        speeds[own] = _speeds[next].Speed;
                    }
                }
                moved[0] += parameters.Scene.MetresPerUnit * (speeds[0] * dt);
                moved[1] += speeds[1] * dt * Math.PI / 180.0;
                // The core's time differs from a multiple of dt by roundings: around each the value is constant.
                Add(text, (step + 1 - Constant) * dt, moved);
                Add(text, (step + 1 + Constant) * dt, moved);
            }
            return text.ToString();
        }

        private static void Add(StringBuilder text, double time, double[] moved) => text.AppendFormat(
            CultureInfo.InvariantCulture, "{0:R},{1:R},{2:R}\n", time, moved[0], moved[1]);

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
