using System;

// What tests of what Unity stores and sends need, and this project does not call.
namespace UnityEngine
{
    public sealed class SerializeReference : Attribute
    {
    }

    public class ScriptableObject : Object
    {
    }

    public class Collider : Component
    {
    }

    public class AnimationCurve
    {
    }

    public struct LayerMask
    {
    }
}

namespace UnityEditor
{
    public static class AssetDatabase
    {
        public static T LoadAssetAtPath<T>(string assetPath)
            where T : UnityEngine.Object
        {
            string root = System.IO.Path.GetDirectoryName(UnityEngine.Application.dataPath);
            string place = PackageManager.PackageInfo.Installed?.assetPath ?? "Assets/Guidewire";
            return assetPath.StartsWith(place + "/", System.StringComparison.Ordinal)
                ? UnityStubs.SceneFile.Prefab(root, "Assets/Guidewire" + assetPath.Substring(place.Length)) as T : null;
        }
    }
}
