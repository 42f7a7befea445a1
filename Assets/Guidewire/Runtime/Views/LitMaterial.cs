using UnityEngine;
using UnityEngine.Rendering;

namespace Guidewire.Runtime
{
    /// <summary>Materials for whatever pipeline draws the scene: with its own lit shader, found at run time.</summary>
    /// <remarks>In the built-in pipeline they are copies of materials in Resources, so that a player contains their
    /// shader. A pipeline's asset names its shader itself. Names of properties are those of all three: the built-in
    /// Standard, URP's Lit, HDRP's Lit.</remarks>
    internal static class LitMaterial
    {
        private const int Transparent = 3000;    // render queue

        private static readonly string[] Colours = { "_BaseColor", "_Color" };
        private static readonly string[] Maps = { "_BaseMap", "_BaseColorMap", "_MainTex" };

        /// <summary>A material of one colour, seen through where its alpha is below 1.</summary>
        public static Material Create(in Color colour)
        {
            RenderPipelineAsset? pipeline = GraphicsSettings.currentRenderPipeline;
            bool isTransparent = colour.a < 1f;
            Shader? lit = pipeline ? pipeline!.defaultShader : null;    // a pipeline of one's own may have none
            Material made;
            if (lit)
            {
                made = new Material(lit!);
                if (isTransparent)
                {
                    SetTransparent(made);
                }
            }
            else
            {
                made = new Material(Resources.Load<Material>(isTransparent ? "Guidewire/Vessel" : "Guidewire/Wire"));
            }
            made.name = "Guidewire";
            SetColour(made, colour);
            return made;
        }

        /// <summary>Sets the colour, whatever the shader calls it.</summary>
        public static void SetColour(Material material, in Color colour)
        {
            foreach (string name in Colours)
            {
                if (material.HasProperty(name))
                {
                    material.SetColor(name, colour);
                }
            }
        }

        /// <summary>Sets the texture, whatever the shader calls it.</summary>
        public static void SetTexture(Material material, Texture texture)
        {
            foreach (string name in Maps)
            {
                if (material.HasProperty(name))
                {
                    material.SetTexture(name, texture);
                }
            }
        }

        // As the inspectors of URP ("_Surface") and HDRP ("_SurfaceType") do it, premultiplied by alpha.
        private static void SetTransparent(Material material)
        {
            material.SetFloat("_Surface", 1f);
            material.SetFloat("_SurfaceType", 1f);
            material.SetFloat("_SrcBlend", (float)BlendMode.One);
            material.SetFloat("_DstBlend", (float)BlendMode.OneMinusSrcAlpha);
            material.SetFloat("_AlphaDstBlend", (float)BlendMode.OneMinusSrcAlpha);
            material.SetFloat("_ZWrite", 0f);
            material.EnableKeyword("_SURFACE_TYPE_TRANSPARENT");
            material.EnableKeyword("_ALPHAPREMULTIPLY_ON");
            material.SetOverrideTag("RenderType", "Transparent");
            material.renderQueue = Transparent;
        }
    }
}
