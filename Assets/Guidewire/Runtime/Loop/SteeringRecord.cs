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

        private readonly List<(int Step, SteeringCommand Command)> _commands =
            new List<(int Step, SteeringCommand Command)>(Block);

        private readonly List<(int Step, Action<SimulationSession> Change)> _changes =
            new List<(int Step, Action<SimulationSession> Change)>();

        private int _command;   // places up to which it was played
        private int _change;

        /// <summary>How many changes of the hand's commands it holds.</summary>
        public int Count => _commands.Count;

        internal void Add(int step, in SteeringCommand command)
        {
            if (_commands.Count > 0 && _commands[_commands.Count - 1].Command.Equals(command))
            {
                return;
            }
            if (_commands.Count == _commands.Capacity)
            {
                _commands.Capacity += Block;
            }
            _commands.Add((step, command));
        }

        internal void Add(int step, Action<SimulationSession> change) => _changes.Add((step, change));

        /// <summary>Begins to play it.</summary>
        internal void Rewind()
        {
            _command = 0;
            _change = 0;
        }

        /// <summary>The command of a step; steps are asked for in their order.</summary>
        internal SteeringCommand At(int step)
        {
            while (_command < _commands.Count && _commands[_command].Step <= step)
            {
                _command++;
            }
            return _command == 0 ? default : _commands[_command - 1].Command;
        }

        /// <summary>Gives the next change before a step, or null.</summary>
        internal Action<SimulationSession>? ChangeAt(int step) =>
            _change < _changes.Count && _changes[_change].Step <= step ? _changes[_change++].Change : null;
    }
}
