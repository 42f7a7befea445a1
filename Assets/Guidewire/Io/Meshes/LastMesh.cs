using System;
using System.Linq;
using System.Security.Cryptography;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Keeps the mesh that was read last, for the next run in this process or a change of parameters: if the
    /// file has the same contents and the same placement, its hierarchy and checks are not computed again, which for
    /// tens of thousands of triangles takes longer than many a run. Runs have the same bits either way.</summary>
    /// <remarks>One run at a time: its walls share their work memory.</remarks>
    public sealed class LastMesh
    {
        private string _file = "";
        private byte[] _bytes = Array.Empty<byte>();
        private double _scale;
        private Vector3d[] _rims = Array.Empty<Vector3d>();
        private Placement _placement;
        private MeshShape? _wall;

        /// <summary>SHA-256 of what was read, in hex.</summary>
        internal string Sha256 { get; private set; } = "";

        /// <summary>Gives the wall in a file, placed.</summary>
        /// <param name="file">As of <see cref="MeshFile.Read"/>.</param>
        /// <param name="scale">Units of the scene per unit of the file.</param>
        /// <param name="rims">A point near the middle of each rim that may be open, in the file's own units.</param>
        /// <param name="placement">In the scene.</param>
        /// <param name="content">What stands in the file; null: it is read.</param>
        /// <exception cref="ParameterException">The file cannot be read or holds no such wall.</exception>
        internal MeshShape Read(string file, double scale, Vector3d[] rims, in Placement placement,
            byte[]? content = null)
        {
            byte[] bytes = content ?? MeshFile.ReadBytes(file);
            if (_wall != null && file == _file && scale == _scale && placement.Equals(_placement)
                && rims.SequenceEqual(_rims) && bytes.AsSpan().SequenceEqual(_bytes))
            {
                return _wall.ForNextRun();
            }
            _wall = null;
            _wall = new MeshShape(MeshFile.Make(file, bytes, scale, rims), placement);
            (_file, _bytes, _scale, _rims, _placement) = (file, bytes, scale, rims, placement);
            using SHA256 sha = SHA256.Create();
            Sha256 = BitConverter.ToString(sha.ComputeHash(bytes)).Replace("-", "").ToLowerInvariant();
            return _wall;
        }
    }
}
