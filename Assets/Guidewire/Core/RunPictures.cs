using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Fluoroscopic pictures of a run: its vessel, and its wire with radii and attenuation by its material.
    /// </summary>
    /// <remarks>At an effective energy of 60 keV iron has a mass attenuation coefficient of 0.1205 m^2/kg and nitinol
    /// (56 % nickel, 0.1512; 44 % titanium, 0.0766) of 0.118 (NIST, tables of Hubbell and Seltzer, 2004): both are
    /// taken as 0.12, and polymers of catheters too, which are filled with salts of barium or bismuth. The wire of pbd
    /// has no material: its optical depth across is 1, and its unit is a mm.</remarks>
    public sealed class RunPictures
    {
        private const double MassAttenuation = 0.12;   // m^2/kg
        private const double Margin = 1.05;            // of the picture's side, around what is shown
        private const double Millimetre = 1e-3;        // m

        private readonly Fluoroscopy _fluoroscopy;
        private readonly Extents? _vessel;
        private readonly double _perUnit;   // mm
        private readonly double[] _radii;
        private readonly double[] _innerRadii;
        private readonly double[] _attenuations;
        private ImagedInstrument[] _instruments = Array.Empty<ImagedInstrument>();
        private double? _attenuation;

        /// <param name="parameters">Those of the run.</param>
        public RunPictures(SimulationParameters parameters)
        {
            bool isMaterial = MethodTable.Of(parameters.Method.Solver).TakesMaterial;
            double metres = isMaterial ? parameters.Scene.MetresPerUnit : Millimetre;
            _perUnit = metres / Millimetre;
            var vessels = new List<WallSurface>();
            var corners = new List<Vector3d>();
            foreach (ContactShape wall in parameters.Scene.Walls)
            {
                if (!(wall is MeshShape || wall is TubeShape))
                {
                    continue;
                }
                Extents box = Extents.Of(wall)!.Value;
                vessels.Add(WallSurface.Create(wall, 0.5 * (box.Low + box.High), 2.0 * box.LargestSide));
                corners.Add(box.Low);
                corners.Add(box.High);
            }
            _vessel = corners.Count == 0 ? (Extents?)null : Extents.Of(corners);
            _fluoroscopy = new Fluoroscopy(vessels);
            double[] lengths = ElementLayout.Lengths(parameters, 1.0, out double[] stations);
            _radii = new double[lengths.Length];
            _innerRadii = new double[lengths.Length];
            _attenuations = new double[lengths.Length];
            for (int j = 0; j < lengths.Length; j++)
            {
                if (!isMaterial)
                {
                    _radii[j] = parameters.Contact.SphereRadius;
                    _attenuations[j] = 0.5 / _radii[j];
                    continue;
                }
                double middle = 0.5 * (stations[j] + stations[j + 1]);
                CrossSection here = CrossSection.At(parameters.Material, middle);
                double inner = CrossSection.LumenAt(parameters.Material, middle);
                double area = Math.PI * (here.Radius * here.Radius - inner * inner);
                _radii[j] = here.Radius / metres;
                _innerRadii[j] = inner / metres;
                _attenuations[j] = MassAttenuation * here.LineDensity / area * metres;
            }
        }

        /// <summary>Length of a unit, mm.</summary>
        public double MillimetresPerUnit => _perUnit;

        /// <summary>Outer radius of each element of the wire, units.</summary>
        public IReadOnlyList<double> Radii => _radii;

        /// <summary>Radius of each element's lumen, units.</summary>
        public IReadOnlyList<double> InnerRadii => _innerRadii;

        /// <summary>Attenuation coefficient of each element's material, 1/unit.</summary>
        public IReadOnlyList<double> Attenuations => _attenuations;

        /// <summary>Takes a picture.</summary>
        /// <param name="positions">Of the wire's n + 1 nodes, units.</param>
        /// <param name="view">What picture.</param>
        /// <param name="grey">Takes the grey levels, row by row from the upper left corner.</param>
        /// <exception cref="ArgumentException">A value out of its range.</exception>
        public void Draw(Vector3d[] positions, PictureView view, Span<byte> grey)
        {
            FluoroscopySettings asked = view.Settings;
            string? problem = asked.FindProblem();
            if (problem != null)
            {
                throw new ArgumentException(problem);
            }
            var settings = new FluoroscopySettings
            {
                Vessel = asked.Vessel,
                Contrast = asked.Contrast * _perUnit,
                Background = asked.Background,
                Noise = asked.Noise,
                Seed = asked.Seed,
                Blur = asked.Blur / _perUnit,
            };
            _fluoroscopy.Draw(Instruments(positions, view.Attenuation), Arm(positions, view), settings, grey);
        }

        private ImagedInstrument[] Instruments(Vector3d[] positions, double? attenuation)
        {
            if (_instruments.Length == 0 || attenuation != _attenuation)
            {
                var attenuations = (double[])_attenuations.Clone();
                if (attenuation.HasValue)
                {
                    Array.Fill(attenuations, attenuation.Value * _perUnit);
                }
                _attenuation = attenuation;
                _instruments = new[] { new ImagedInstrument(positions, _radii, _innerRadii, attenuations) };
            }
            _instruments[0].Positions = positions;
            return _instruments;
        }

        private CArm Arm(Vector3d[] positions, PictureView view)
        {
            Extents box = _vessel ?? Extents.Of(positions);
            Vector3d middle = view.Centre ?? 0.5 * (box.Low + box.High);
            double side = view.FieldOfView / _perUnit ?? 0.0;
            if (!view.FieldOfView.HasValue)
            {
                // The box as the C-arm sees it, from its middle: with a scale of 1 pixel is 1 unit.
                var look = new CArm(view.LeftOblique, view.Cranial, 0.5 * (box.Low + box.High), 1.0, 1);
                for (int corner = 0; corner < 8; corner++)
                {
                    Vector3d seen = look.ToDetector(new Vector3d((corner & 1) == 0 ? box.Low.X : box.High.X,
                        (corner & 2) == 0 ? box.Low.Y : box.High.Y, (corner & 4) == 0 ? box.Low.Z : box.High.Z));
                    side = Math.Max(side, 2.0 * Margin * Math.Max(Math.Abs(seen.X - 0.5), Math.Abs(seen.Y - 0.5)));
                }
            }
            return new CArm(view.LeftOblique, view.Cranial, middle, side, view.Pixels);
        }
    }
}
