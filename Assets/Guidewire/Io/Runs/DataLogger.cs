using System;
using System.IO;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Writes positions.json (thesis 3.2.3) as the run goes, one entry a line, in constant memory: <c>{"0":
    /// {"totalTime": s, "elapsedMilliseconds": ms, "delta": units, "sphere": {"0": {"x","y","z","vx","vy","vz"}, ...}},
    /// "1": ...}</c>, and where asked for <c>"orientation": {"0": {"x","y","z","w"}, ...}</c> and <c>"contact":
    /// {"total": {"x","y","z"}, "reaction": ..., "sphere": {"i": ..., spheres without contact left out}}</c> and
    /// <c>"stress": {"kineticEnergy": J, .., "curvature": [[x, y, z], ...], ..}</c> as key logStrains says, and
    /// <c>"hub": {"insertion": m, ..}</c> as key logHub does; of a catheter over the wire <c>"catheters":
    /// [{"sphere": [[x, y, z], ...], "extension": m, ..}]</c>, units but for what its hub has.</summary>
    /// <remarks>Entry "k" is the state after k steps. Until <see cref="Close"/> the file is not whole JSON, but every
    /// line that ends is a whole entry. Numbers are round-trip exact; one that is not finite is null.</remarks>
    internal sealed class DataLogger : StateLog
    {
        private const int Buffer = 1 << 16;
        private const double FlushAfter = 1000.0;     // ms of run time

        private readonly Stream _stream;
        private readonly RunParameters _parameters;
        private byte[] _bytes = new byte[Buffer];
        private int _length;
        private bool _empty = true;
        private double _flushed;

        /// <summary>A log into a stream, which it closes.</summary>
        /// <param name="stream">Where to write.</param>
        /// <param name="parameters">What to write of each state.</param>
        public DataLogger(Stream stream, RunParameters parameters)
        {
            _stream = stream;
            _parameters = parameters;
            Append("{\n");
        }

        /// <inheritdoc/>
        public override void Log(Simulation simulation, double elapsed)
        {
            RodState state = simulation.State;
            Append(_empty ? "\"" : ",\n\"");
            _empty = false;
            Append(simulation.StepCount);
            Append("\": {\"totalTime\": ");
            Append(simulation.Time);
            Append(", \"elapsedMilliseconds\": ");
            Append(elapsed);
            Append(", \"delta\": ");
            Append(simulation.PredictionError);
            Append(", \"sphere\": {");
            int first = _parameters.LogSpheres == LoggedSpheres.Last ? state.ElementCount : 0;
            for (int i = first; i < state.SphereCount; i++)
            {
                Append(i == first ? "\"" : ", \"");
                Append(i);
                Append("\": {");
                Append("\"x\": ", state.Positions[i].X);
                Append(", \"y\": ", state.Positions[i].Y);
                Append(", \"z\": ", state.Positions[i].Z);
                Append(", \"vx\": ", state.Velocities[i].X);
                Append(", \"vy\": ", state.Velocities[i].Y);
                Append(", \"vz\": ", state.Velocities[i].Z);
                Append("}");
            }
            Append("}");
            if (_parameters.LogOrientations)
            {
                AppendOrientations(state);
            }
            if (_parameters.LogStrains)
            {
                AppendStress(simulation);
            }
            if (_parameters.Sheath != null)
            {
                Append(", \"inBody\": ");
                Append(simulation.Hub()?.SpheresInBody ?? 0);
            }
            if (_parameters.LogHub && simulation.Hub() is HubRecord hub)
            {
                AppendHub(hub);
            }
            if (simulation.Coaxial() is CoaxialRecord catheter)
            {
                AppendCatheters(catheter, _parameters.LogContacts && simulation.Contacts != null);
            }
            if (_parameters.LogContacts && simulation.Contacts != null)
            {
                AppendContacts(simulation.Contacts);
            }
            Append("}");
            if (elapsed - _flushed > FlushAfter)
            {
                _flushed = elapsed;
                Flush();
            }
        }

        /// <inheritdoc/>
        public override void Close()
        {
            Append("\n}\n");
            Flush();
            if (_stream is FileStream file)
            {
                file.Flush(true);
            }
            _stream.Dispose();
        }

        /// <inheritdoc/>
        public override void Dispose() => _stream.Dispose();

        private void AppendOrientations(RodState state)
        {
            Append(", \"orientation\": {");
            for (int j = 0; j < state.ElementCount; j++)
            {
                Append(j == 0 ? "\"" : ", \"");
                Append(j);
                Append("\": {");
                Append("\"x\": ", state.Orientations[j].X);
                Append(", \"y\": ", state.Orientations[j].Y);
                Append(", \"z\": ", state.Orientations[j].Z);
                Append(", \"w\": ", state.Orientations[j].W);
                Append("}");
            }
            Append("}");
        }

        private void AppendStress(Simulation simulation)
        {
            StressRecord? stress = simulation.Stress();
            if (stress == null)
            {
                return;
            }
            Append(", \"stress\": {\"kineticEnergy\": ", stress.KineticEnergy);
            Append(", \"elasticEnergy\": ", stress.ElasticEnergy);
            Append(", \"potentialEnergy\": ", stress.PotentialEnergy);
            Append(", \"curvature\": ", stress.Curvature);
            Append(", \"couple\": ", stress.Couple);
            Append(", \"strain\": ", stress.Strain);
            Append(", \"force\": ", stress.Force);
            Append(", \"angularVelocity\": ", simulation.State.AngularVelocities);
            Append("}");
        }

        private void AppendHub(HubRecord hub)
        {
            Append(", \"hub\": {\"insertion\": ", hub.Insertion);
            Append(", \"turn\": ", hub.Turn);
            Append(", \"force\": ", hub.Force);
            Append(", \"torque\": ", hub.Torque);
            Append(", \"tipDirection\": ", hub.TipDirection);
            Append(", \"twist\": ", hub.Twist);
            Append(", \"largestCurvature\": ", hub.LargestCurvature);
            if (hub.LengthInBody is double length)
            {
                Append(", \"lengthInBody\": ", length);
            }
            Append("}");
        }

        private void AppendCatheters(CoaxialRecord outermost, bool hasContacts)
        {
            Append(", \"catheters\": [{");
            for (CoaxialRecord? one = outermost; one != null; one = one.Inside)
            {
                AppendCatheter(one, hasContacts);
                Append(one.Inside == null ? "}]" : "}, {");
            }
        }

        private void AppendCatheter(CoaxialRecord catheter, bool hasContacts)
        {
            Append("\"sphere\": ", catheter.Positions);
            if (_parameters.LogOrientations)
            {
                Append(", \"orientation\": ");
                for (int j = 0; j < catheter.Orientations.Length; j++)
                {
                    Quaterniond q = catheter.Orientations[j];
                    Append(j == 0 ? "[[" : ", [", q.X);
                    Append(", ", q.Y);
                    Append(", ", q.Z);
                    Append(", ", q.W);
                    Append("]");
                }
                Append("]");
            }
            Append(", \"extension\": ", catheter.Extension);
            if (_parameters.LogHub)
            {
                Append(", \"insertion\": ", catheter.Insertion);
                Append(", \"turn\": ", catheter.Turn);
                Append(", \"force\": ", catheter.Force);
                Append(", \"torque\": ", catheter.Torque);
            }
            if (hasContacts)
            {
                Append(", \"contactForces\": ", catheter.ContactForces);
            }
            if (hasContacts && catheter.WallDisplacements.Length > 0)
            {
                Append(", \"wallDisplacements\": ", catheter.WallDisplacements);
            }
        }

        private void Append(string name, Vector3d[] values)
        {
            Append(name);
            for (int i = 0; i < values.Length; i++)
            {
                Append(i == 0 ? "[[" : ", [", values[i].X);
                Append(", ", values[i].Y);
                Append(", ", values[i].Z);
                Append("]");
            }
            Append("]");
        }

        private void AppendContacts(ContactRecord contacts)
        {
            Append(", \"contact\": {\"total\": ", contacts.Total);
            Append(", \"reaction\": ", contacts.Reaction);
            Append(", \"sphere\": ");
            AppendNonzero(contacts.Forces);
            for (int w = 0; w < contacts.WallForces.Length; w++)
            {
                Append(w == 0 ? ", \"wall\": {\"0\": " : ", \"" + w + "\": ", contacts.WallForces[w]);
            }
            Append(contacts.WallForces.Length > 0 ? "}" : "");
            if (contacts.ElementForces.Length > 0)
            {
                Append(", \"totalMean\": ", contacts.MeanTotal);
                Append(", \"reactionAtEnd\": ", contacts.ReactionAtEnd);
                Append(", \"pressure\": ", contacts.Pressure);
                Append(", \"element\": ");
                AppendNonzero(contacts.ElementForces);
            }
            if (contacts.Displacements.Length > 0)
            {
                Append(", \"largestDisplacement\": ", contacts.LargestDisplacement);
                Append(", \"meanDisplacement\": ", contacts.MeanDisplacement);
                Append(", \"displacement\": ");
                AppendNonzero(contacts.Displacements);
            }
            Append("}");
        }

        private void AppendNonzero(Vector3d[] forces)
        {
            Append("{");
            bool first = true;
            for (int i = 0; i < forces.Length; i++)
            {
                if (forces[i] != Vector3d.Zero)
                {
                    Append(first ? "\"" : ", \"");
                    Append(i);
                    Append("\": ", forces[i]);
                    first = false;
                }
            }
            Append("}");
        }

        private void Append(string name, in Vector3d value)
        {
            Append(name);
            Append("{\"x\": ", value.X);
            Append(", \"y\": ", value.Y);
            Append(", \"z\": ", value.Z);
            Append("}");
        }

        private void Append(string name, double value)
        {
            Append(name);
            Append(value);
        }

        private void Append(string ascii)
        {
            Reserve(ascii.Length);
            for (int i = 0; i < ascii.Length; i++)
            {
                _bytes[_length + i] = (byte)ascii[i];
            }
            _length += ascii.Length;
        }

        private void Append(int value)
        {
            Reserve(16);
            System.Buffers.Text.Utf8Formatter.TryFormat(value, _bytes.AsSpan(_length), out int written);
            _length += written;
        }

        private void Append(double value)
        {
            if (double.IsNaN(value) || double.IsInfinity(value))
            {
                Append("null");
                return;
            }
            Reserve(NumberText.Longest);
            _length += NumberText.Write(value, _bytes, _length);
        }

        private void Reserve(int count)
        {
            if (_length + count > _bytes.Length)
            {
                Flush();
            }
        }

        private void Flush()
        {
            _stream.Write(_bytes, 0, _length);
            _length = 0;
        }
    }
}
