using System;
using System.Collections.Generic;
using System.Linq;

namespace Guidewire.Core
{
    /// <summary>Builds the parts of the direct solver from a run's parameters.</summary>
    internal static class DirectSetup
    {
        // As many times the iterations of a stage: a wall that is pressed to its limit takes more than a rigid one.
        private const int BetweenSoftWalls = 2;

        /// <summary>Gives the motion of a scene's rod by the direct solver.</summary>
        /// <param name="work">What the run may take; null where all of the run is this motion.</param>
        public static RodDynamics DynamicsOf(SimulationParameters parameters, MaterialScene scene, RodTerms terms,
            WorkLimit? work = null)
        {
            bool isSoft = Array.Exists(scene.Walls, wall => wall.Softness != null);
            int most = (isSoft ? BetweenSoftWalls : 1) * parameters.Method.MaxNewtonIterations;
            var dynamics = new RodDynamics(terms, scene.Schedule, scene.Shape, Scheme(parameters.Method.Integrator),
                parameters.Method.SolverTolerance, most, work)
            {
                Cancellation = parameters.Method.Cancellation,
            };
            dynamics.Control.Tolerance = parameters.Method.TimeStepError;
            dynamics.Begin(scene.Velocities, scene.Spins,
                parameters.Scene.InitialState == InitialState.Equilibrium);
            return dynamics;
        }

        /// <summary>What walls add to a wire's energy.</summary>
        public static WallTerms WallTermsOf(SimulationParameters parameters, MaterialScene scene, Barrier barrier,
            SupportSpring spring)
        {
            double move = parameters.Drive.LargestMove(parameters.Method.TimeStep, scene.Metres);
            var contact = new BarrierEnergy(scene.Rod, scene.Walls, scene.Metres, barrier, scene.Supports.SheathEnd);
            bool hasOwn = scene.Supports.Coaxial != null
                && parameters.Scene.Catheters.Any(catheter => catheter.FrictionCoefficient > 0.0);
            FrictionEnergy? friction = hasOwn
                || Array.Exists(scene.Walls, wall => wall.FrictionCoefficient > 0.0)
                ? new FrictionEnergy(contact, scene.Rod.ElementCount, 0.0, scene.Rod.Capacity) : null;
            SetFriction(parameters, scene, friction);
            // Searched for on demand: the rule measures the narrowest width of the whole vessel.
            ContactParameters given = parameters.Contact;
            Func<string?>? advice = null;
            if (given.ContactDistance != 0.0 || given.ContactStiffness != 0.0)
            {
                advice = () => BarrierDefaults.Advice(barrier, BarrierDefaults.Of(scene.Rod, new ContactParameters(),
                    scene.Walls, scene.Metres, move));
            }
            return new WallTerms(contact, friction, spring, scene.Supports.HasSpring, advice,
                SelfContactOf(parameters, scene, barrier));
        }

        private static (SelfContact Contact, SelfFriction? Friction)? SelfContactOf(SimulationParameters parameters,
            MaterialScene scene, in Barrier barrier)
        {
            ContactParameters given = parameters.Contact;
            if (!given.TouchesItself(scene.Walls.Length))
            {
                return null;
            }
            var contact = new SelfContact(scene.Rod, barrier, scene.Supports.SheathEnd);
            return (contact, given.SelfFriction > 0.0
                ? new SelfFriction(contact, scene.Rod, given.SelfFriction, SlipOf(given, scene.Rod)) : null);
        }

        private static double SlipOf(ContactParameters contact, MaterialRod rod) =>
            contact.ElasticSlip > 0.0 ? contact.ElasticSlip : FrictionEnergy.ElasticSlipOf(rod);

        /// <summary>Sets the coefficients of instruments, and the elastic slip by the rule.</summary>
        /// <param name="friction">Null: there is none.</param>
        public static void SetFriction(SimulationParameters parameters, MaterialScene scene, FrictionEnergy? friction)
        {
            if (friction == null)
            {
                return;
            }
            friction.ElasticSlip = SlipOf(parameters.Contact, scene.Rod);
            CoaxialJoints? coaxial = scene.Supports.Coaxial?.Joints;
            IReadOnlyList<Catheter> catheters = parameters.Scene.Catheters;
            for (int i = 0; coaxial != null && i < catheters.Count; i++)
            {
                friction.SetCoefficient(i == 0 ? 0 : coaxial.TipOf(i - 1), coaxial.TipOf(i),
                    catheters[i].FrictionCoefficient);
            }
        }

        /// <summary>Gives the scheme of an integrator of the direct solver; null for BDF2.</summary>
        public static RungeKuttaScheme? Scheme(Integrator integrator)
        {
            switch (integrator)
            {
                case Integrator.ImplicitEuler:
                    return RungeKuttaScheme.ImplicitEuler();
                case Integrator.Bdf2:
                    return null;
                case Integrator.Trbdf2:
                    return RungeKuttaScheme.TrBdf2();
                case Integrator.Esdirk3:
                    return RungeKuttaScheme.Esdirk3();
                case Integrator.Esdirk4:
                    return RungeKuttaScheme.Esdirk4();
                default:
                    throw new ArgumentException("the direct solver has no integrator " + integrator);
            }
        }
    }
}
