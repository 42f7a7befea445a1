using UnityEngine;
using UnityEngine.Rendering;

namespace Guidewire.Runtime
{
    /// <summary>Materials for whatever pipeline draws the scene.</summary>
    /// <remarks>They are copies of materials in Resources, whose shader is this package's own: every player contains
    /// it, and the built-in pipeline and URP draw it alike. HDRP draws only shaders of its own: there they have its
    /// lit shader, which the pipeline's asset names in the editor.</remarks>
    internal static class LitMaterial
    {
        private const int Transparent = 3000;    // render queue

        private static readonly string[] Colours = { "_BaseColor", "_Color" };
        private static readonly string[] Maps = { "_BaseColorMap", "_MainTex" };

        /// <summary>A material of one colour, seen through where its alpha is below 1.</summary>
        public static Material Create(in Color colour)
        {
            RenderPipelineAsset? pipeline = GraphicsSettings.currentRenderPipeline;
            bool isTransparent = colour.a < 1f;
            Shader? lit = pipeline ? pipeline!.defaultShader : null;    // a pipeline of one's own may have none
            Material made;
            if (lit && lit!.name.StartsWith("HDRP", System.StringComparison.Ordinal))
            {
                made = new Material(lit);
                if (isTransparent)
                {
                    SetTransparent(made);
                }
            }
            else
            {
                made = new Material(Resources.Load<Material>(isTransparent ? "Guidewire/Vessel" : "Guidewire/Wire"));
            }
            (made.name, made.hideFlags) = ("Guidewire", HideFlags.DontSave);
            foreach (string name in Colours)
            {
                if (made.HasProperty(name))
                {
                    made.SetColor(name, colour);
                }
            }
            return made;
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

        // As HDRP's inspector does it, premultiplied by alpha.
        private static void SetTransparent(Material material)
        {
            material.SetFloat("_SurfaceType", 1f);
            material.SetFloat("_SrcBlend", (float)BlendMode.One);
            material.SetFloat("_DstBlend", (float)BlendMode.OneMinusSrcAlpha);
            material.SetFloat("_AlphaDstBlend", (float)BlendMode.OneMinusSrcAlpha);
            material.SetFloat("_ZWrite", 0f);
            material.EnableKeyword("_SURFACE_TYPE_TRANSPARENT");
            material.SetOverrideTag("RenderType", "Transparent");
            material.renderQueue = Transparent;
        }
    }
}
