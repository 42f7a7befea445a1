using System;

// What this project does not call, and scripts in general do: names with the signatures of Unity's, for the checker,
// which
// compiles what users add.
namespace UnityEngine
{
    public sealed class SerializeReference : Attribute
    {
    }

    [AttributeUsage(AttributeTargets.Method)]
    public sealed class ContextMenu : Attribute
    {
        public ContextMenu(string itemName)
        {
        }
    }

    public class Coroutine
    {
    }

    public class ScriptableObject : Object
    {
        public static T CreateInstance<T>()
            where T : ScriptableObject
        {
            return (T)System.Activator.CreateInstance(typeof(T));
        }
    }

    public class Collider : Component
    {
    }

    public class Collider2D : Behaviour
    {
    }

    public class Collision
    {
    }

    public class Collision2D
    {
    }

    public class AnimationCurve
    {
    }

    public struct LayerMask
    {
        public static int NameToLayer(string layerName) => -1;
    }
}

namespace UnityEditor
{
    public static class AssetDatabase
    {
        public static void Refresh()
        {
        }

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
