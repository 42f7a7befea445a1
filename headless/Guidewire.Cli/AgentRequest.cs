using System;
using System.Linq;
using Guidewire.Core;
using Guidewire.Io;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Cli
{
    /// <summary>Requests for contrast agent in a session's vessel: how blood flows, injections, and what is
    /// where.</summary>
    internal static class AgentRequest
    {
        /// <summary>The cells of the vessel's tree, for whoever draws pictures of their own; null without
        /// one.</summary>
        /// <param name="flow">Lengths in mm.</param>
        /// <param name="millimetres">Of a unit.</param>
        public static JObject? Cells(ContrastFlow? flow, double millimetres)
        {
            if (flow == null)
            {
                return null;
            }
            var middles = new JArray();
            foreach (Vector3d middle in flow.Middles)
            {
                middles.Add(middle.X / millimetres);
                middles.Add(middle.Y / millimetres);
                middles.Add(middle.Z / millimetres);
            }
            return new JObject
            {
                ["middles"] = middles,
                ["radii"] = new JArray(Array.ConvertAll(flow.Radii, radius => radius / millimetres)),
            };
        }

        /// <summary>Does what a request asks for, and fills its answer but for the parts of agent, one for each
        /// cell.</summary>
        /// <returns>These parts.</returns>
        /// <exception cref="ParameterException">It cannot be met; nothing has changed.</exception>
        public static ReadOnlySpan<double> Answer(SimulationSession session, RunRequest request, JObject answer)
        {
            SessionContrast contrast = session.Contrast
                ?? throw new ParameterException("request: there is no contrast in a"
                + " vessel without a centreline: 'guidewire.py anatomy' finds one, vessel.anatomy names its file");
            Vector3d? place = request.AtInlet ? (Vector3d?)null : Tip(session, request.Hub);
            try
            {
                if (request.Flow != null)
                {
                    contrast.Begin(Read(request.Flow));
                }
                if (request.Amount is double amount)
                {
                    contrast.Inject(place, amount, request.Rate);
                }
            }
            catch (ArgumentException error)
            {
                throw new ParameterException("request: " + error.Message);
            }
            ContrastFlow flow = contrast.Flow;
            flow.Advance(request.Seconds);
            answer["isActive"] = flow.IsActive;
            answer["isInjecting"] = flow.IsInjecting;
            answer["injected"] = flow.Injected;
            answer["held"] = flow.Held;
            answer["washedOut"] = flow.WashedOut;
            answer["inlet"] = flow.Inlet;
            return flow.Parts;
        }

        private static Vector3d Tip(SimulationSession session, int hub)
        {
            session.CheckHub(hub);
            return session.Simulation.Centrelines().ElementAt(hub)[^1];
        }

        private static BloodFlow Read(JObject given)
        {
            var flow = new BloodFlow();
            foreach (JProperty property in given.Properties())
            {
                switch (property.Name)
                {
                    case "inlet":
                        flow.Inlet = Number(property);
                        break;
                    case "dispersion":
                        flow.Dispersion = Number(property);
                        break;
                    case "pulse":
                        flow.PulseAmplitude = Number(property);
                        break;
                    case "pulseRate":
                        flow.PulseRate = Number(property);
                        break;
                    default:
                        throw new ParameterException("request: flow has no " + property.Name
                            + ": it has inlet, dispersion, pulse and pulseRate");
                }
            }
            return flow;
        }

        private static double Number(JProperty property)
        {
            return property.Value.Type == JTokenType.Integer || property.Value.Type == JTokenType.Float
                ? (double)property.Value : throw new ParameterException("request", property.Name,
                    property.Value.ToString(Formatting.None), "a number");
        }
    }
}
