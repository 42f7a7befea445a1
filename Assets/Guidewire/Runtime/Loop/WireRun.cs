using System;
using System.Collections.Generic;
using System.Threading;
using Guidewire.Core;
using Guidewire.Io;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>A run and whoever steps it: a thread of its own, or the host between two frames. Both do the same work,
    /// so the same commands by step give the same bits.</summary>
    /// <remarks>The host asks for time and says what the hand does; <see cref="Work"/> does one piece of it: opens the
    /// run, makes a change or a step. Only who calls that touches the session. What the two share is guarded by a lock
    /// that is never held during work; states go through a <see cref="StateExchange"/>.</remarks>
    internal sealed class WireRun : IDisposable
    {
        private readonly Func<Action<string>, CancellationToken, SimulationSession> _open;
        private readonly SteeringRecord? _recording;
        private readonly SteeringRecord? _replay;
        private readonly CancellationTokenSource _cancel = new CancellationTokenSource();
        private readonly CancellationToken _cancellation;
        private readonly object _gate = new object();

        // Guarded.
        private readonly List<Action<SimulationSession>> _changes = new List<Action<SimulationSession>>();
        private readonly double[] _hubs = new double[2 * HubCommands.Most];    // speeds of push and turn of each
        private double _due;      // s of in-game time asked for and not simulated
        private int _extra;       // steps asked for beside them
        private bool _wantsPoints;
        private bool _isAsked;    // since the thread began to wait

        // Of who steps.
        private SimulationSession? _session;
        private WireState? _mine;
        private readonly double[] _asked = new double[2 * HubCommands.Most];    // as of the step
        private readonly double[] _motion = new double[2 * HubCommands.Most];
        private readonly double[] _before = new double[HubCommands.Most];    // shortfalls, m
        private Thread? _thread;

        private volatile RunDescription? _description;
        private volatile ShownStates? _opened;
        private volatile StateExchange? _exchange;
        private volatile Exception? _failure;
        private volatile string _progress = "opening";
        private volatile bool _isStopped;

        /// <summary>A run that is to be opened.</summary>
        /// <param name="open">Opens it; told where to report progress.</param>
        /// <param name="recording">Takes what it is commanded, or null.</param>
        /// <param name="replay">What it is commanded instead of what the hand does, or null.</param>
        public WireRun(Func<Action<string>, CancellationToken, SimulationSession> open, SteeringRecord? recording,
            SteeringRecord? replay)
        {
            _open = open;
            _cancellation = _cancel.Token;
            _recording = recording;
            _replay = replay;
            replay?.Rewind();
        }

        /// <summary>What of the run does not change; null until it is open.</summary>
        public RunDescription? Description => _description;

        /// <summary>For the host, from the moment at which the run is open.</summary>
        public ShownStates? Opened => _opened;

        /// <summary>What has stopped it, or null.</summary>
        public Exception? Failure => _failure;

        /// <summary>What is being done until it is open.</summary>
        public string Progress => _progress;

        /// <summary>The session, null for threads other than its own.</summary>
        /// <exception cref="InvalidOperationException">A thread of its own steps it, which is not the caller's.
        /// </exception>
        public SimulationSession? Session => _thread == null || _thread == Thread.CurrentThread ? _session
            : throw new InvalidOperationException(
                "the run belongs to the thread that steps it: use State, or BetweenSteps");

        /// <summary>Whether a thread does the work.</summary>
        public bool HasThread => _thread != null;

        /// <summary>Whether there is work beside the steps of the time that was asked for: the run is to be opened or
        /// changed, or a single step made.</summary>
        public bool IsAskedAtOnce
        {
            get
            {
                lock (_gate)
                {
                    return _opened == null || _extra > 0 || _changes.Count > 0;
                }
            }
        }

        /// <summary>Whether a thread is to do it: not in batch mode, where frames have no time of their own, and not
        /// where there are none.</summary>
        public static bool TakesThread(SteppingMode stepping)
        {
            return stepping == SteppingMode.Worker && !Application.isBatchMode
                && Application.platform != RuntimePlatform.WebGLPlayer;
        }

        /// <summary>Leaves the work to a thread.</summary>
        public void StartThread()
        {
            _thread = new Thread(WorkUntilStopped) { IsBackground = true, Name = "Guidewire" };
            _thread.Start();
        }

        /// <summary>Says what the hand does from now on.</summary>
        public void Steer(HubCommands hubs, float pushSpeed, float turnSpeed, bool wantsPoints)
        {
            lock (_gate)
            {
                hubs.Write(_hubs, pushSpeed, turnSpeed);
                _wantsPoints = wantsPoints;
            }
        }

        /// <summary>Asks for in-game time. What a thread could not do until then is not made up for: the wire would
        /// only fall behind further.</summary>
        /// <param name="seconds">s.</param>
        /// <param name="step">A time step, s.</param>
        public void Ask(double seconds, double step)
        {
            lock (_gate)
            {
                _due = Math.Min(_due, _thread == null ? step : seconds + step) + seconds;
                Wake();
            }
        }

        /// <summary>Forgets the time that was asked for and not simulated, but for this much.</summary>
        public void Forget(double step)
        {
            lock (_gate)
            {
                _due = Math.Min(_due, step);
            }
        }

        /// <summary>Asks for one step.</summary>
        public void AskStep()
        {
            lock (_gate)
            {
                _extra++;
                Wake();
            }
        }

        /// <summary>Asks for something to be done with the session between two steps.</summary>
        public void AskChange(Action<SimulationSession> change)
        {
            lock (_gate)
            {
                _changes.Add(change);
                Wake();
            }
        }

        /// <summary>Takes the newest state.</summary>
        /// <returns>False where there is none since the last.</returns>
        public bool TakeNewest() => _opened != null && _opened.TakeNewest(_exchange!);

        /// <summary>Does one piece of work.</summary>
        /// <returns>False where there is nothing to do until the host asks for more.</returns>
        public bool Work()
        {
            if (_isStopped || _failure != null)
            {
                return false;
            }
            try
            {
                return _session == null ? Open() : Change(_session) || Step(_session);
            }
            catch (OperationCanceledException)
            {
                return false;
            }
            catch (Exception error)
            {
                _failure = error;
                return false;
            }
        }

        /// <summary>Ends the run, and its log with it, also in the middle of a step.</summary>
        /// <param name="patience">Largest time to wait for its thread, ms. A thread that still opens the run ends once
        /// that is done.</param>
        public void Stop(int patience)
        {
            _isStopped = true;
            if (_thread == null)
            {
                End();
                return;
            }
            _cancel.Cancel();
            lock (_gate)
            {
                Wake();
            }
            if (_thread != Thread.CurrentThread)
            {
                _thread.Join(patience);
            }
        }

        /// <summary>Ends the run without waiting for its thread.</summary>
        public void Dispose()
        {
            Stop(0);
            _cancel.Dispose();
        }

        /// <summary>Waits until it has ended: whoever writes to the same log begins after that.</summary>
        public void WaitForEnd() => _thread?.Join();

        private void WorkUntilStopped()
        {
            while (!_isStopped)
            {
                if (!Work())
                {
                    Wait();
                }
            }
            try
            {
                End();
            }
            catch (Exception error)
            {
                _failure = error;
            }
        }

        private void Wake()
        {
            _isAsked = true;
            Monitor.Pulse(_gate);
        }

        private void Wait()
        {
            lock (_gate)
            {
                while (!_isAsked)
                {
                    Monitor.Wait(_gate);
                }
                _isAsked = false;
            }
        }

        private void End()
        {
            SimulationSession? session = _session;
            _session = null;
            session?.Dispose();
        }

        private bool Open()
        {
            SimulationSession session = _open(text => _progress = text, _cancellation);
            if (_recording != null || _replay != null)
            {
                session.RecordSteering();    // its motion is rounded, that of a replay in the same way
            }
            if (_recording != null)
            {
                _recording.Session = session;
            }
            Compilation.Wait();
            _mine = new WireState(session);
            _exchange = new StateExchange(new WireState(session));
            _description = new RunDescription(session, WallMesh.Of(session));
            _session = session;
            _opened = new ShownStates(session);
            return true;
        }

        private bool Change(SimulationSession session)
        {
            Action<SimulationSession>? change = _replay?.ChangeAt(session.Simulation.StepCount);
            if (change == null)
            {
                lock (_gate)
                {
                    if (_changes.Count == 0)
                    {
                        return false;
                    }
                    change = _changes[0];
                    _changes.RemoveAt(0);
                }
                _recording?.Add(session.Simulation.StepCount, change);
            }
            change(session);
            _description = new RunDescription(session, _description!.Walls);
            Publish(session, false);
            return true;
        }

        private bool Step(SimulationSession session)
        {
            double dt = session.Parameters.Method.TimeStep;
            if (session.Simulation.Outcome != Outcome.Running || !TakeDue(dt))
            {
                return false;
            }
            int step = session.Simulation.StepCount;
            _replay?.Read(step, _asked);
            _recording?.Add(step, _asked);
            int hubs = Math.Min(HubCommands.Most, session.InstrumentCount);
            for (int hub = 0; hub < hubs; hub++)
            {
                _motion[2 * hub] = _asked[2 * hub] * dt;
                _motion[2 * hub + 1] = _asked[2 * hub + 1] * dt * Math.PI / 180.0;
                _before[hub] = WireState.ShortfallOf(session, hub);
            }
            session.Step(_motion.AsSpan(0, 2 * hubs));
            bool isJammed = false;
            for (int hub = 0; hub < hubs; hub++)
            {
                double lost = Math.Abs(WireState.ShortfallOf(session, hub) - _before[hub]);
                isJammed |= _motion[2 * hub] != 0.0
                    && lost > 0.5 * Math.Abs(_motion[2 * hub]) * session.Parameters.Scene.MetresPerUnit;
            }
            Publish(session, isJammed);
            return true;
        }

        private bool TakeDue(double dt)
        {
            lock (_gate)
            {
                if (_replay == null)
                {
                    _hubs.CopyTo(_asked, 0);
                }
                if (_extra > 0)
                {
                    _extra--;
                    return true;
                }
                if (_due < dt)
                {
                    return false;
                }
                _due -= dt;
                return true;
            }
        }

        private void Publish(SimulationSession session, bool isJammed)
        {
            bool wantsPoints;
            lock (_gate)
            {
                wantsPoints = _wantsPoints;
            }
            _mine!.CopyFrom(session, isJammed, wantsPoints);
            _exchange!.Publish(ref _mine);
        }
    }
}
