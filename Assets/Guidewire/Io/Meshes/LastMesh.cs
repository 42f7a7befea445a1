using System;
using System.Collections.Generic;
using System.Linq;
using System.Security.Cryptography;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Keeps the meshes that were read last, for the next run or a change of parameters: if the
    /// file has the same contents, its triangles and hierarchy are not computed again, which for tens of thousands of
    /// triangles takes longer than many a run. Runs have the same bits either way.</summary>
    /// <remarks>One run at a time: its walls share their work memory.</remarks>
    public sealed class LastMesh
    {
        private const int MostInPlace = 3;     // walls of runs that alternate between vessels

        private readonly KeptMeshes _kept;
        private readonly List<(KeptMeshes.Entry Entry, Placement Placement, SmoothWarp? Warp, MeshShape Wall)> _walls =
            new List<(KeptMeshes.Entry, Placement, SmoothWarp?, MeshShape)>();    // the newest last

        /// <param name="kept">Meshes of this run and of others at once; null: one of its own.</param>
        public LastMesh(KeptMeshes? kept = null)
        {
            _kept = kept ?? new KeptMeshes(1);
        }

        /// <summary>SHA-256 of what was read, in hex.</summary>
        internal string Sha256 { get; private set; } = "";

        /// <summary>How it moved.</summary>
        internal LastMotion Motion { get; } = new LastMotion();

        /// <summary>Gives the wall in a file, placed.</summary>
        /// <param name="file">As of <see cref="MeshFile.Read"/>.</param>
        /// <param name="scale">Units of the scene per unit of the file.</param>
        /// <param name="rims">A point near the middle of each rim that may be open, in the file's own units.</param>
        /// <param name="placement">In the scene.</param>
        /// <param name="content">What stands in the file; null: it is read.</param>
        /// <param name="warp">What moves the vertices before they are placed; null: nothing.</param>
        /// <exception cref="ParameterException">The file cannot be read or holds no such wall.</exception>
        internal MeshShape Read(string file, double scale, Vector3d[] rims, in Placement placement,
            byte[]? content = null, SmoothWarp? warp = null)
        {
            KeptMeshes.Entry entry = _kept.Find(file, content ?? MeshFile.ReadBytes(file), scale, rims);
            Sha256 = entry.Sha256;
            Placement where = placement;
            int known = _walls.FindIndex(one => one.Entry == entry && one.Placement.Equals(where)
                && Equals(one.Warp, warp));
            var wall = known >= 0 ? _walls[known] : default;
            // Of those that were moved the last one is enough: no other run has that placement again.
            _walls.RemoveAll(one => (known >= 0 && one.Wall == wall.Wall) || one.Warp != null
                || !one.Placement.Equals(Placement.Identity));
            if (known < 0)
            {
                wall = (entry, placement, warp, entry.Wall.At(placement, warp));
            }
            _walls.Add(wall);
            _walls.RemoveRange(0, Math.Max(0, _walls.Count - MostInPlace));
            return known < 0 ? wall.Wall : wall.Wall.ForNextRun();
        }
    }

    /// <summary>The meshes that were read last, without a placement, for all runs of a process, also at once.</summary>
    public sealed class KeptMeshes
    {
        private readonly int _most;
        private readonly List<Entry> _entries = new List<Entry>();    // the newest last

        /// <param name="most">How many are kept.</param>
        public KeptMeshes(int most)
        {
            _most = most;
        }

        /// <summary>The wall in a file; arguments and errors as of <see cref="LastMesh.Read"/>.</summary>
        internal Entry Find(string file, byte[] bytes, double scale, Vector3d[] rims)
        {
            lock (_entries)
            {
                Entry? entry = _entries.Find(one => one.File == file && one.Scale == scale
                    && one.Rims.SequenceEqual(rims) && bytes.AsSpan().SequenceEqual(one.Bytes));
                _entries.RemoveAll(one => one == entry || (one.File == file && one.Scale == scale && entry == null));
                entry ??= new Entry(file, bytes, scale, rims);
                _entries.Add(entry);
                _entries.RemoveRange(0, Math.Max(0, _entries.Count - _most));
                return entry;
            }
        }

        /// <summary>Forgets all.</summary>
        public void Clear()
        {
            lock (_entries)
            {
                _entries.Clear();
            }
        }

        /// <summary>SHA-256 of what stands in a file, in hex.</summary>
        internal static string Sum(byte[] bytes)
        {
            using SHA256 sha = SHA256.Create();
            return BitConverter.ToString(sha.ComputeHash(bytes)).Replace("-", "").ToLowerInvariant();
        }

        /// <summary>A file's mesh.</summary>
        internal sealed class Entry
        {
            public Entry(string file, byte[] bytes, double scale, Vector3d[] rims)
            {
                (File, Bytes, Scale, Rims) = (file, bytes, scale, rims);
                Wall = new MeshShape(MeshFile.Make(file, bytes, scale, rims));
                Sha256 = Sum(bytes);
            }

            public string File { get; }

            public byte[] Bytes { get; }

            public double Scale { get; }

            public Vector3d[] Rims { get; }

            public MeshShape Wall { get; }

            public string Sha256 { get; }
        }
    }
}
