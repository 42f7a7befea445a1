using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Blue to grey to red, as a texture of one row: a material that takes it is lit and coloured by texture
    /// coordinate, with Unity's own shader.</summary>
    internal static class ColourMap
    {
        /// <summary>The texture coordinate of the value 0: grey.</summary>
        public const float Middle = 0.5f;

        private const int Width = 256;

        /// <summary>Gives the texture coordinate of a value.</summary>
        /// <param name="value">Any number; beyond the range it takes the end's colour.</param>
        /// <param name="range">The value of the last colour, positive.</param>
        public static float Coordinate(double value, float range)
        {
            float coordinate = Middle + 0.5f * (float)value / range;
            return float.IsNaN(coordinate) ? Middle : Mathf.Clamp(coordinate, 0.5f / Width, 1f - 0.5f / Width);
        }

        /// <summary>Creates the texture.</summary>
        public static Texture2D Create()
        {
            var pixels = new Color32[Width];
            var blue = new Color(0.1f, 0.3f, 0.9f);
            var grey = new Color(0.75f, 0.76f, 0.78f);
            var red = new Color(0.9f, 0.15f, 0.1f);
            for (int i = 0; i < Width; i++)
            {
                float coordinate = 2f * i / (Width - 1) - 1f;
                pixels[i] = Color.Lerp(grey, coordinate < 0f ? blue : red, Mathf.Abs(coordinate));
            }
            var texture = new Texture2D(Width, 1) { wrapMode = TextureWrapMode.Clamp, name = "Colours" };
            texture.SetPixels32(pixels);
            texture.Apply();
            return texture;
        }
    }

    /// <summary>What the wire's colour shows.</summary>
    public enum Colouring
    {
        /// <summary>The colour shows nothing.</summary>
        Plain,

        /// <summary>Length of an element over its rest length, less 1.</summary>
        Stretch,

        /// <summary>The colour shows curvature in 1/unit.</summary>
        Bending,

        /// <summary>The colour shows twist in rad/unit.</summary>
        Twist,
    }
}
