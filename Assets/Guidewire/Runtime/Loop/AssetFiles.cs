using System;
using System.Collections.Generic;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Text assets in place of files, wherever they lie in a project: an asset has no folder, so a name finds
    /// it.</summary>
    internal static class AssetFiles
    {
        private const long Short = 1 << 16;    // bytes: the text itself is looked at, of others only how long it is

        /// <summary>What stands in assets, by their names.</summary>
        /// <exception cref="ArgumentException">An entry names no asset, or two have one name.</exception>
        public static Dictionary<string, byte[]> Read(TextAsset?[] assets)
        {
            var files = new Dictionary<string, byte[]>();
            foreach (TextAsset? asset in assets)
            {
                if (!asset)
                {
                    throw new ArgumentException("an entry of the files names no asset");
                }
                if (!files.TryAdd(asset!.name, asset.bytes))
                {
                    throw new ArgumentException("two of the files have the name " + asset.name);
                }
            }
            return files;
        }

        /// <summary>Another text where something else stands in an asset.</summary>
        public static string Key(TextAsset? asset) =>
            !asset ? "" : asset!.name + (asset.dataSize < Short ? asset.text : asset.dataSize.ToString());
    }
}
