using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Fluoroscopic pictures of a run: its vessel, and its wire and catheters with radii and attenuation by
    /// their material.</summary>
    /// <remarks>At an effective energy of 60 keV iron has a mass attenuation coefficient of 0.1205 m^2/kg and nitinol
    /// (56 % nickel, 0.1512; 44 % titanium, 0.0766) of 0.118 (NIST, tables of Hubbell and Seltzer, 2004): both are
    /// taken as 0.12, and polymers of catheters too, which are filled with salts of barium or bismuth. Markers take
    /// more (<see cref="WireSection.Attenuation"/>). The wire of pbd has no material: its optical depth across is 1,
    /// and its unit is a mm.</remarks>
    public sealed class RunPictures
    {
        private const double MassAttenuation = 0.12;   // m^2/kg
        private const double Margin = 1.05;            // of the picture's side, around what is shown
        private const double Millimetre = 1e-3;        // m
        private const double Stretch = 1e-3;           // of an element's length, by which it may be longer

        private readonly Fluoroscopy _fluoroscopy;
        private readonly List<WallIndentation> _walls = new List<WallIndentation>();    // as the fluoroscopy has them
        private readonly List<int> _numbers = new List<int>();    // of these walls in the scene
        private readonly Extents? _vessel;
        private readonly double _perUnit;   // mm
        private readonly PatientAxes? _axes;
        private readonly ImagedInstrument[] _instruments;
        private readonly double[] _lengths;   // of the wire's elements, units
        private readonly ImagedInstrument _markers;   // of the wire, without the rest of it
        private ImagedInstrument[] _drawn;
        private double? _attenuation;
        private ContrastFlow? _contrast;

        /// <param name="parameters">Those of the run.</param>
        public RunPictures(SimulationParameters parameters)
        {
            bool isMaterial = MethodTable.Of(parameters.Method.Solver).TakesMaterial;
            double metres = isMaterial ? parameters.Scene.MetresPerUnit : Millimetre;
            _perUnit = metres / Millimetre;
            _axes = parameters.Scene.PatientAxes;
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
                _numbers.Add(Array.IndexOf(parameters.Scene.Walls, wall));
                _walls.Add(new WallIndentation(parameters, wall, vessels[vessels.Count - 1].Vertices));
                corners.Add(box.Low);
                corners.Add(box.High);
            }
            _vessel = corners.Count == 0 ? (Extents?)null : Extents.Of(corners);
            _fluoroscopy = new Fluoroscopy(vessels);
            _instruments = new ImagedInstrument[1 + parameters.Scene.Catheters.Count];
            _instruments[0] = InstrumentOf(parameters, isMaterial, metres);
            for (int k = 1; k < _instruments.Length; k++)
            {
                SimulationParameters own = parameters.OfCatheter(parameters.Scene.Catheters[k - 1], Vector3d.UnitZ);
                _instruments[k] = InstrumentOf(own, isMaterial, metres);
            }
            _markers = WithAttenuation(_instruments[0], 0.0);
            _drawn = _instruments;
            _lengths = ElementLayout.Lengths(parameters, 1.0, out _);
        }

        /// <summary>Length of a unit, mm.</summary>
        public double MillimetresPerUnit => _perUnit;

        /// <summary>The wire and then the catheters, with radii and attenuation of their elements; where they are is
        /// said with each picture.</summary>
        public IReadOnlyList<ImagedInstrument> Instruments => _instruments;

        /// <summary>Contrast agent that pictures show with <see cref="VesselContrast.Injected"/>, or null.</summary>
        public ContrastFlow? Contrast
        {
            get => _contrast;
            set
            {
                _contrast = value;
                SetCells(null);
            }
        }

        /// <summary>Takes a picture.</summary>
        /// <param name="centrelines">Nodes of each instrument, units.</param>
        /// <param name="view">What picture.</param>
        /// <param name="grey">Takes the grey levels, row by row from the upper left corner.</param>
        /// <param name="displacements">Of soft walls at the instruments' elements, m; none: walls are at rest.</param>
        /// <param name="now">The run, for walls that move to be where they are in it; null: they are at rest.</param>
        /// <exception cref="ArgumentException">A value out of its range.</exception>
        public void Draw(IReadOnlyList<Vector3d[]> centrelines, PictureView view, Span<byte> grey,
            IReadOnlyList<Vector3d[]>? displacements = null, Simulation? now = null)
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
            Place(centrelines, view.Attenuation);
            bool isMoved = false;
            for (int k = 0; k < _walls.Count; k++)
            {
                if (_walls[k].Move(centrelines, displacements ?? Array.Empty<Vector3d[]>(),
                    now?.FieldOf(_numbers[k])))
                {
                    _fluoroscopy.Move(k, _walls[k].Vertices);
                    isMoved |= k == 0 && now?.FieldOf(_numbers[0]) != null;
                }
            }
            if (isMoved && asked.Vessel == VesselContrast.Injected)
            {
                SetCells(now!.FieldOf(_numbers[0]));
            }
            var shown = new List<ImagedInstrument>(_drawn);
            if (shown.Count > 1)
            {
                shown[0] = ThroughTips(shown[0], centrelines);
                shown.Add(_markers);
            }
            _fluoroscopy.Draw(shown, Arm(centrelines[0], view), settings, grey,
                _contrast != null ? _contrast.Parts : default);
        }

        // Contrast agent goes with the vessel; null: that is at rest.
        private void SetCells(WallField? field)
        {
            if (_contrast != null && _vessel.HasValue)
            {
                _fluoroscopy.SetCells(Array.ConvertAll(_contrast.Middles, point =>
                    {
                        Vector3d rest = 1.0 / _perUnit * point;
                        return field?.Moved(rest) ?? rest;
                    }), Array.ConvertAll(_contrast.Radii, radius => radius / _perUnit));
            }
        }

        private static ImagedInstrument InstrumentOf(SimulationParameters parameters, bool isMaterial, double metres)
        {
            double[] lengths = ElementLayout.Lengths(parameters, 1.0, out double[] stations);
            var radii = new double[lengths.Length];
            var innerRadii = new double[lengths.Length];
            var attenuations = new double[lengths.Length];
            for (int j = 0; j < lengths.Length; j++)
            {
                if (!isMaterial)
                {
                    radii[j] = parameters.Contact.SphereRadius;
                    attenuations[j] = 0.5 / radii[j];
                    continue;
                }
                double middle = 0.5 * (stations[j] + stations[j + 1]);
                CrossSection here = CrossSection.At(parameters.Material, middle);
                double inner = CrossSection.LumenAt(parameters.Material, middle);
                double area = Math.PI * (here.Radius * here.Radius - inner * inner);
                radii[j] = here.Radius / metres;
                innerRadii[j] = inner / metres;
                attenuations[j] = MassAttenuation * here.LineDensity / area * metres;
            }
            return new ImagedInstrument(new Vector3d[lengths.Length + 1], radii, innerRadii, attenuations)
            {
                Bands = isMaterial ? BandsOf(parameters.Material, stations, metres) : Array.Empty<OpaqueBand>(),
            };
        }

        // stations: of the nodes, units.
        private static OpaqueBand[] BandsOf(MaterialParameters material, double[] stations, double metres)
        {
            var bands = new List<OpaqueBand>();
            foreach (WireSection section in material.Sections)
            {
                for (int j = 0; j + 1 < stations.Length && section.Attenuation.HasValue; j++)
                {
                    double length = stations[j + 1] - stations[j];
                    double from = Math.Max(section.From - stations[j], 0.0) / length;
                    double to = Math.Min(section.To - stations[j], length) / length;
                    if (to - from > Stretch)
                    {
                        bands.Add(new OpaqueBand(j, from, to, section.Attenuation.Value / Millimetre * metres));
                    }
                }
            }
            return bands.ToArray();
        }

        private void Place(IReadOnlyList<Vector3d[]> centrelines, double? attenuation)
        {
            if (attenuation != _attenuation)
            {
                _attenuation = attenuation;
                _drawn = attenuation is double all ? Array.ConvertAll(_instruments, one => WithAttenuation(one, all))
                    : _instruments;
            }
            for (int k = 0; k < _drawn.Length; k++)
            {
                _drawn[k].Positions = centrelines[k];
            }
            _markers.Positions = centrelines[0];
        }

        // The wire with the tips that it comes out of: the chord of an element there would cut the corner.
        private ImagedInstrument ThroughTips(ImagedInstrument wire, IReadOnlyList<Vector3d[]> centrelines)
        {
            var points = new List<Vector3d>(centrelines[0]);
            var elements = new List<int>();
            for (int j = 0; j < _lengths.Length; j++)
            {
                elements.Add(j);
            }
            for (int k = 1; k < centrelines.Count; k++)
            {
                Vector3d tip = centrelines[k][centrelines[k].Length - 1];
                int crossing = -1;
                double least = double.PositiveInfinity;
                for (int j = 0; j < elements.Count; j++)
                {
                    double behind = (points[j] - tip).Length;
                    double beyond = (points[j + 1] - tip).Length;
                    double excess = behind + beyond - (points[j + 1] - points[j]).Length;
                    if (behind + beyond <= (1.0 + Stretch) * _lengths[elements[j]] && excess < least)
                    {
                        least = excess;
                        crossing = Math.Min(behind, beyond) > 0.0 ? j : -1;
                    }
                }
                if (crossing >= 0)
                {
                    points.Insert(crossing + 1, tip);
                    elements.Insert(crossing, elements[crossing]);
                }
            }
            double[] Of(double[] values) => elements.ConvertAll(j => values[j]).ToArray();
            return new ImagedInstrument(points.ToArray(), Of(wire.Radii), Of(wire.InnerRadii), Of(wire.Attenuations));
        }

        private ImagedInstrument WithAttenuation(ImagedInstrument one, double perMillimetre)
        {
            var attenuations = new double[one.Radii.Length];
            Array.Fill(attenuations, perMillimetre * _perUnit);
            return new ImagedInstrument(one.Positions, one.Radii, one.InnerRadii, attenuations) { Bands = one.Bands };
        }

        private CArm Arm(Vector3d[] positions, PictureView view)
        {
            Extents box = _vessel ?? Extents.Of(positions);
            Vector3d middle = view.Centre ?? 0.5 * (box.Low + box.High);
            double side = view.FieldOfView / _perUnit ?? 0.0;
            if (!view.FieldOfView.HasValue)
            {
                // The box as the C-arm sees it, from its middle: with a scale of 1 pixel is 1 unit.
                var look = new CArm(view.LeftOblique, view.Cranial, 0.5 * (box.Low + box.High), 1.0, 1,
                    _axes);
                for (int corner = 0; corner < 8; corner++)
                {
                    Vector3d seen = look.ToDetector(new Vector3d((corner & 1) == 0 ? box.Low.X : box.High.X,
                        (corner & 2) == 0 ? box.Low.Y : box.High.Y, (corner & 4) == 0 ? box.Low.Z : box.High.Z));
                    side = Math.Max(side, 2.0 * Margin * Math.Max(Math.Abs(seen.X - 0.5), Math.Abs(seen.Y - 0.5)));
                }
            }
            return new CArm(view.LeftOblique, view.Cranial, middle, side, view.Pixels, _axes);
        }
    }
}
