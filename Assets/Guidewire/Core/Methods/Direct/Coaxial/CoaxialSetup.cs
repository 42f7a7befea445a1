using System;

namespace Guidewire.Core
{
    /// <summary>Builds what is simulated of a wire in a catheter: scenes of both as if alone, and both as one
    /// rod.</summary>
    internal sealed class CoaxialSetup
    {
        private readonly SimulationParameters _parameters;
        private readonly InstrumentProfile _wireProfile;
        private readonly InstrumentProfile _catheterProfile;
        private readonly double _drag;

        /// <summary>For the wire and the catheter of these parameters.</summary>
        public CoaxialSetup(SimulationParameters parameters)
        {
            _parameters = parameters;
            SimulationParameters wire = parameters.Copy();
            wire.Scene.Start = null;   // of a run that goes on; its snapshot says all of it
            Wire = SceneOf(wire);
            SimulationParameters catheter = wire.OfCatheter(parameters.Scene.Catheters[0], Axis);
            Catheter = SceneOf(catheter);
            _wireProfile = ProfileOf(wire, Wire.Metres);
            _catheterProfile = ProfileOf(catheter, Wire.Metres);
            _drag = parameters.Material.MassDamping;
            WireStations = CoaxialRod.StationsOf(Wire.Rod);
        }

        /// <summary>The wire as if it were alone.</summary>
        public MaterialScene Wire { get; }

        /// <summary>The catheter as if it were alone.</summary>
        public MaterialScene Catheter { get; }

        /// <summary>Along which both hubs move, a unit vector.</summary>
        public Vector3d Axis => Wire.Schedule.Hub.Frame.Director3;

        /// <summary>Radius of the catheter's lumen, m.</summary>
        public double LumenRadius => _parameters.Scene.Catheters[0].Material.InnerRadius;

        /// <summary>Distance of each of the wire's nodes from its hub, m.</summary>
        public double[] WireStations { get; }

        /// <summary>Both as one rod.</summary>
        /// <param name="beyond">Wire nodes beyond the catheter's tip.</param>
        /// <param name="lead">How far the wire's hub is behind the catheter's, m.</param>
        public CoaxialRod Rod(int beyond, double lead)
        {
            var rod = new CoaxialRod(Catheter.Rod, _catheterProfile, Wire.Rod, _wireProfile, beyond, lead);
            rod.Rod.MassDamping = _drag;
            return rod;
        }

        /// <summary>A drive of one of the hubs along the axis.</summary>
        public MaterialDrive DriveOf(MaterialScene scene)
        {
            return new MaterialDrive(scene.Drive, scene.Schedule.Hub, Axis);
        }

        /// <summary>Energies and loads of both, which follow their hubs.</summary>
        public RodTerms Terms(MaterialScene scene, CoaxialHubs hubs)
        {
            var terms = new RodTerms(scene.Rod, scene.Supports, _parameters.Scene, null, Array.Empty<EnergyTerm>());
            ((CoaxialBendTwist)terms.Bending).Hubs = hubs;
            return terms;
        }

        /// <summary>The motion of both.</summary>
        public RodDynamics Dynamics(MaterialScene scene, RodTerms terms)
        {
            return DirectSetup.DynamicsOf(_parameters, scene, terms);
        }

        private static MaterialScene SceneOf(SimulationParameters parameters)
        {
            return new MaterialScene(parameters, new Scene(parameters));
        }

        private static InstrumentProfile ProfileOf(SimulationParameters parameters, double metres)
        {
            return new InstrumentProfile(new WireProfile(parameters.Material, parameters.Scene.GuidewireLength), metres);
        }
    }
}
