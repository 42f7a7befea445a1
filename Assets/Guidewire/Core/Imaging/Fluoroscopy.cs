using System;
using System.Collections.Generic;
using System.Numerics;
using System.Runtime.CompilerServices;

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
            for (int k = 0; k < _vessels.Count; k++)
            {
                corners.AddRange(_moved[k] ?? _vessels[k].Vertices);
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

    /// <summary>The noise of counted quanta, from a seed: the sum of the four bytes of a hash of seed and pixel, which
    /// is near to a normal distribution. Integers of 32 bits only, so that a shader has the same noise.</summary>
    internal static class QuantumNoise
    {
        // Mean, and variance 4 (256^2 - 1)/12, of the sum of four bytes.
        private const int Mean = 510;
        private static readonly float PerDeviation = (float)(1.0 / Math.Sqrt(4.0 * 65535.0 / 12.0));

        /// <summary>Gives what a seed contributes to every pixel's hash.</summary>
        public static uint Start(uint seed) => Mixed(seed ^ 0x9e3779b9u);

        /// <summary>Gives a pixel's deviation, in standard deviations.</summary>
        /// <param name="start">Of the seed.</param>
        /// <param name="pixel">Its number.</param>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static float At(uint start, uint pixel)
        {
            uint h = Mixed(start + pixel);
            uint pairs = (h & 0x00ff00ffu) + ((h >> 8) & 0x00ff00ffu);
            return ((int)((pairs & 0xffffu) + (pairs >> 16)) - Mean) * PerDeviation;
        }

        // lowbias32 by C. Wellons.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static uint Mixed(uint h)
        {
            h ^= h >> 16;
            h *= 0x7feb352du;
            h ^= h >> 15;
            h *= 0x846ca68bu;
            return h ^ (h >> 16);
        }
    }

    /// <summary>Blurs a picture by a Gaussian focal spot of the X-ray tube: rows, then columns. Beyond its border the
    /// picture is continued with the values at the border.</summary>
    internal sealed class SpotBlur
    {
        private const double Extent = 3.0;    // standard deviations

        private readonly float[] _rows;
        private readonly int _pixels;
        private float[] _line = Array.Empty<float>();       // a row, with what is beyond its ends
        private float[] _weights = Array.Empty<float>();    // of the middle pixel and of those beside it
        private double _deviation;

        /// <param name="pixels">Of a side.</param>
        public SpotBlur(int pixels)
        {
            _pixels = pixels;
            _rows = new float[pixels * pixels];
        }

        /// <summary>Blurs a picture by the tube's spot.</summary>
        /// <param name="picture">Row by row.</param>
        /// <param name="deviation">Standard deviation, pixels, above 0.</param>
        public void Apply(float[] picture, double deviation)
        {
            SetWeights(deviation);
            int extent = _weights.Length - 1;
            for (int row = 0; row < _pixels; row++)
            {
                int start = row * _pixels;
                Array.Copy(picture, start, _line, extent, _pixels);
                _line.AsSpan(0, extent).Fill(picture[start]);
                _line.AsSpan(extent + _pixels, extent).Fill(picture[start + _pixels - 1]);
                Array.Clear(_rows, start, _pixels);
                Add(_weights[0], _line, extent, _rows, start);
                for (int k = 1; k <= extent; k++)
                {
                    Add(_weights[k], _line, extent - k, _rows, start);
                    Add(_weights[k], _line, extent + k, _rows, start);
                }
            }
            Array.Clear(picture, 0, picture.Length);
            for (int row = 0; row < _pixels; row++)
            {
                for (int k = -extent; k <= extent; k++)
                {
                    int from = Math.Min(Math.Max(row + k, 0), _pixels - 1) * _pixels;
                    Add(_weights[Math.Abs(k)], _rows, from, picture, row * _pixels);
                }
            }
        }

        private void Add(float weight, float[] from, int first, float[] to, int start)
        {
            int x = 0;
            for (; x <= _pixels - Vector<float>.Count; x += Vector<float>.Count)
            {
                (new Vector<float>(to, start + x) + weight * new Vector<float>(from, first + x)).CopyTo(to, start + x);
            }
            for (; x < _pixels; x++)
            {
                to[start + x] += weight * from[first + x];
            }
        }

        private void SetWeights(double deviation)
        {
            if (deviation == _deviation)
            {
                return;
            }
            _deviation = deviation;
            int extent = Math.Min((int)Math.Ceiling(Extent * deviation), _pixels);
            _weights = new float[extent + 1];
            double sum = -1.0;
            for (int k = 0; k <= extent; k++)
            {
                sum += 2.0 * Weight(k, deviation);
            }
            for (int k = 0; k <= extent; k++)
            {
                _weights[k] = (float)(Weight(k, deviation) / sum);
            }
            _line = new float[_pixels + 2 * extent];
        }

        private static double Weight(int k, double deviation) => Math.Exp(-0.5 * k * k / (deviation * deviation));
    }

    /// <summary>The view of a run's picture, as requested. Lengths are in mm unless stated otherwise.</summary>
    public sealed class PictureView
    {
        /// <summary>LAO, degrees; RAO is negative.</summary>
        public double LeftOblique { get; set; }

        /// <summary>Degrees; caudal is negative.</summary>
        public double Cranial { get; set; }

        /// <summary>What is in the middle, units; null: the middle of the vessel, or without one of the wire.</summary>
        public Vector3d? Centre { get; set; }

        /// <summary>Side of the square, mm; null: so that the vessel, or without one the wire, is seen.</summary>
        public double? FieldOfView { get; set; }

        /// <summary>Pixels of a side.</summary>
        public int Pixels { get; set; } = 256;

        /// <summary>Linear attenuation coefficient of all instruments, 1/mm; null: by their materials.</summary>
        public double? Attenuation { get; set; }

        /// <summary>The settings of the picture, with mm in place of units.</summary>
        public FluoroscopySettings Settings { get; } = new FluoroscopySettings();
    }
}
