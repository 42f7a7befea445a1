using System;
using System.Collections.Generic;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Reads how the patient lies in the scene: as the key patientAxes says, or else as the vessel's file
    /// does.</summary>
    internal static class PatientAxesReader
    {
        /// <summary>Sets the axes of a scene.</summary>
        /// <param name="values">Its parameters, the vessel's file read.</param>
        /// <param name="sourceOf">Who said what stands at a path.</param>
        /// <param name="warnings">Gets a line where key and file disagree.</param>
        public static void Read(RunParameters values, Func<string, string> sourceOf, List<string> warnings)
        {
            PatientAxes? ofVessel = values.Anatomy?.Axes;
            PatientAxes? axes = PatientAxes.Named(values.PatientAxes) ?? ofVessel;
            values.Simulation.Scene.PatientAxes = axes;
            if (ofVessel != null && !ofVessel.Equals(axes))
            {
                warnings.Add(sourceOf("patientAxes") + ": patientAxes " + values.PatientAxes
                    + " are not those of the vessel as it is placed");
            }
        }
    }
}
