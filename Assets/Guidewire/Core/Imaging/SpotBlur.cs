using System;
using System.Numerics;

namespace Guidewire.Core
{
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
}
