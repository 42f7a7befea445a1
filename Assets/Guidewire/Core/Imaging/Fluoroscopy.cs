using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Fluoroscopic pictures of instruments in vessels. Nothing here takes part in a step.</summary>
    /// <remarks>The brightness of a pixel is background * vessel * exp(-sum of mu t) along its rays (Beer and Lambert),
    /// where tissue is part of the background. What the vessel takes away or adds is kept for as long as it is seen
    /// from the same place. Blur and noise come last, then 255 times the brightness is rounded to a grey
    /// level.</remarks>
    public sealed class Fluoroscopy
    {
        private readonly IReadOnlyList<WallSurface> _vessels;
        private readonly Vector3d[]?[] _moved;    // vertices of a vessel that is not at rest
        private LumenThickness[] _lumens = Array.Empty<LumenThickness>();
        private CArm? _arm;
        private float[] _thickness = Array.Empty<float>();    // pixels' sides
        private float[] _layer = Array.Empty<float>();        // brightness without instruments
        private float[] _depth = Array.Empty<float>();
        private float[] _picture = Array.Empty<float>();
        private InstrumentShadow _shadow = new InstrumentShadow(Array.Empty<float>(), 0);
        private SpotBlur? _blur;
        private (VesselContrast, double, double) _shown;
        private LumenCells? _cells;
        private CArm? _cellsArm;
        private double[] _agent = Array.Empty<double>();

        /// <param name="vessels">What may be filled with contrast agent.</param>
        public Fluoroscopy(IReadOnlyList<WallSurface> vessels)
        {
            _vessels = vessels;
            _moved = new Vector3d[vessels.Count][];
        }

        /// <summary>Says where the vertices of a vessel are from now on.</summary>
        /// <param name="vessel">Its number.</param>
        /// <param name="vertices">Units.</param>
        public void Move(int vessel, Vector3d[] vertices)
        {
            _moved[vessel] = vertices;
            _arm = null;
            _cellsArm = null;
        }

        /// <summary>Says where contrast agent may be: the cells of the vessels' tree.</summary>
        /// <param name="middles">Units.</param>
        /// <param name="radii">Units.</param>
        public void SetCells(Vector3d[] middles, double[] radii)
        {
            var corners = new List<Vector3d>();
            foreach (WallSurface vessel in _vessels)
            {
                corners.AddRange(vessel.Vertices);
            }
            Extents box = Extents.Of(corners);
            _cells = new LumenCells(middles, radii, box.Low, box.High);
            _cellsArm = null;
        }

        /// <summary>Takes a picture.</summary>
        /// <param name="instruments">What is in the vessels.</param>
        /// <param name="arm">Where it is seen from.</param>
        /// <param name="settings">What is shown.</param>
        /// <param name="grey">Takes the grey levels, row by row from the upper left corner.</param>
        /// <param name="parts">Of the blood in each cell that is contrast agent; none: nothing is injected.</param>
        /// <exception cref="ArgumentException">A setting out of its range, or another number of grey
        /// levels.</exception>
        public void Draw(IReadOnlyList<ImagedInstrument> instruments, CArm arm, FluoroscopySettings settings,
            Span<byte> grey, ReadOnlySpan<double> parts = default)
        {
            string? problem = settings.FindProblem();
            if (problem != null || grey.Length != arm.Pixels * arm.Pixels)
            {
                throw new ArgumentException(problem ?? "a picture needs as many grey levels as it has pixels");
            }
            SetLayer(arm, settings, parts);
            Array.Clear(_depth, 0, _depth.Length);
            for (int k = 0; k < instruments.Count; k++)
            {
                _shadow.Add(instruments[k], arm);
                _shadow.AddBands(instruments[k], arm);
            }
            for (int i = 0; i < _picture.Length; i++)
            {
                _picture[i] = _depth[i] == 0.0f ? _layer[i] : _layer[i] * MathF.Exp(-_depth[i]);
            }
            if (settings.Blur > 0.0)
            {
                _blur!.Apply(_picture, settings.Blur * arm.Scale);
            }
            if (settings.Noise > 0.0)
            {
                AddNoise(settings);
            }
            for (int i = 0; i < _picture.Length; i++)
            {
                grey[i] = (byte)(255.0f * Math.Min(1.0f, Math.Max(0.0f, _picture[i])) + 0.5f);
            }
        }

        private void AddNoise(FluoroscopySettings settings)
        {
            uint start = QuantumNoise.Start(settings.Seed);
            float noise = (float)(settings.Noise * Math.Sqrt(settings.Background));
            for (int i = 0; i < _picture.Length; i++)
            {
                _picture[i] += noise * MathF.Sqrt(_picture[i]) * QuantumNoise.At(start, (uint)i);
            }
        }

        private void SetLayer(CArm arm, FluoroscopySettings settings, ReadOnlySpan<double> parts)
        {
            bool isNewView = !arm.Equals(_arm);
            if (isNewView)
            {
                SetSize(arm.Pixels);
                Array.Clear(_thickness, 0, _thickness.Length);
                for (int i = 0; i < _lumens.Length; i++)
                {
                    _lumens[i].MoveVertices(_moved[i]);
                    _lumens[i].Add(arm, _thickness);
                }
                _arm = arm;
            }
            if (settings.Vessel == VesselContrast.Injected && parts.Length > 0 && _cells != null)
            {
                SetAgent(arm, settings, parts);
                return;
            }
            var shown = (settings.Vessel, settings.Contrast, settings.Background);
            if (isNewView || !shown.Equals(_shown))
            {
                _shown = shown;
                for (int i = 0; i < _layer.Length; i++)
                {
                    _layer[i] = (float)(settings.Background * settings.VesselFactor(_thickness[i] / arm.Scale));
                }
            }
        }

        private void SetAgent(CArm arm, FluoroscopySettings settings, ReadOnlySpan<double> parts)
        {
            if (!arm.Equals(_cellsArm))
            {
                _cells!.Look(arm, _lumens);
                _cellsArm = arm;
            }
            _cells!.Sum(parts, _agent);
            for (int i = 0; i < _layer.Length; i++)
            {
                _layer[i] = (float)(settings.Background * Math.Exp(-settings.Contrast * _agent[i]));
            }
            _shown = default;    // what else may be shown is computed anew
        }

        private void SetSize(int pixels)
        {
            if (_depth.Length == pixels * pixels)
            {
                return;
            }
            _thickness = new float[pixels * pixels];
            _agent = new double[pixels * pixels];
            _layer = new float[pixels * pixels];
            _depth = new float[pixels * pixels];
            _picture = new float[pixels * pixels];
            _shadow = new InstrumentShadow(_depth, pixels);
            _blur = new SpotBlur(pixels);
            _lumens = new LumenThickness[_vessels.Count];
            for (int i = 0; i < _lumens.Length; i++)
            {
                _lumens[i] = new LumenThickness(_vessels[i], pixels);
            }
        }
    }
}
