using System;
using System.Collections.Generic;
using System.Linq;
using System.Security.Cryptography;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Keeps the mesh that was read last, for the next run in this process or a change of parameters: if the
    /// file has the same contents, its triangles and hierarchy are not computed again, which for tens of thousands of
    /// triangles takes longer than many a run. Runs have the same bits either way.</summary>
    /// <remarks>One run at a time: its walls share their work memory.</remarks>
    public sealed class LastMesh
    {
        private readonly KeptMeshes _kept;
        private Placement _placement;
        private SmoothWarp? _warp;
        private KeptMeshes.Entry? _entry;
        private MeshShape? _wall;

        /// <param name="kept">Meshes of this run and of others at once; null: one of its own.</param>
        public LastMesh(KeptMeshes? kept = null)
        {
            _kept = kept ?? new KeptMeshes(1);
        }

        /// <summary>SHA-256 of what was read, in hex.</summary>
        internal string Sha256 => _entry?.Sha256 ?? "";

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
            if (_wall != null && entry == _entry && placement.Equals(_placement) && Equals(warp, _warp))
            {
                return _wall.ForNextRun();
            }
            (_wall, _entry, _placement, _warp) = (null, entry, placement, warp);
            return _wall = entry.Wall.At(placement, warp);
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

        /// <summary>A file's mesh.</summary>
        internal sealed class Entry
        {
            public Entry(string file, byte[] bytes, double scale, Vector3d[] rims)
            {
                (File, Bytes, Scale, Rims) = (file, bytes, scale, rims);
                Wall = new MeshShape(MeshFile.Make(file, bytes, scale, rims));
                using SHA256 sha = SHA256.Create();
                Sha256 = BitConverter.ToString(sha.ComputeHash(bytes)).Replace("-", "").ToLowerInvariant();
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
