using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Contact as published (thesis 3.1.2): at the predicted state, whatever is within a sphere's radius of
    /// the wall touches; see <see cref="SeedContactConstraint"/>. Nothing keeps the wire from passing.</summary>
    internal sealed class SeedContactRule : IContactRule
    {
        private const int ContactsPerSphere = 4;
        private readonly ContactShape[] _walls;
        private readonly double _radius;
        private readonly SeedContactConstraint _contacts;
        private readonly int[] _elementHint;
        private readonly int[] _sphereHint;
        private double _deepest;

        /// <param name="state">The wire, with its final masses.</param>
        /// <param name="parameters">Radius, margin and gain.</param>
        public SeedContactRule(RodState state, SimulationParameters parameters)
        {
            _walls = parameters.Walls;
            _radius = parameters.SphereRadius;
            _contacts = new SeedContactConstraint(state, ContactsPerSphere * _walls.Length * state.SphereCount,
                parameters.SphereRadius + parameters.CollisionMargin, parameters.CollisionStiffness);
            _elementHint = new int[_walls.Length * state.ElementCount];
            _sphereHint = new int[_walls.Length * state.SphereCount];
            Array.Fill(_elementHint, -1);
            Array.Fill(_sphereHint, -1);
        }

        /// <inheritdoc/>
        public bool GuardsSpheres => false;

        /// <inheritdoc/>
        public bool GuardsElements => false;

        /// <inheritdoc/>
        public int ContactCount => _contacts.Count;

        /// <inheritdoc/>
        public void Detect(Vector3d[] from, Vector3d[] to)
        {
            _contacts.Clear();
            _deepest = 0.0;
            for (int w = 0; w < _walls.Length; w++)
            {
                for (int i = 0; i < to.Length; i++)
                {
                    if (_walls[w].Nearest(
                        to[i], to[i], _radius, ref _sphereHint[w * to.Length + i], out SurfaceContact contact))
                    {
                        _contacts.AddSphere(i, contact);
                        _deepest = Math.Max(_deepest, _radius - contact.Distance);
                    }
                }
                for (int j = 0; j + 1 < to.Length; j++)
                {
                    if (_walls[w].Nearest(
                        to[j], to[j + 1], _radius, ref _elementHint[w * (to.Length - 1) + j],
                        out SurfaceContact contact))
                    {
                        _contacts.AddElement(j, contact, to);
                        _deepest = Math.Max(_deepest, _radius - contact.Distance);
                    }
                }
            }
        }

        /// <inheritdoc/>
        public void AddImpact(int j, bool isElement, in SurfaceContact contact)
        {
            throw new InvalidOperationException("the published rule has no swept test");
        }

        /// <inheritdoc/>
        public double ClearanceOf(int j)
        {
            return 0.0;
        }

        /// <inheritdoc/>
        public void Sweep(Vector3d[] x)
        {
            _contacts.Sweep(x);
        }

        /// <inheritdoc/>
        public void SpheresOf(int k, out int first, out int last)
        {
            first = last = _contacts.SphereOf(k);
        }

        /// <inheritdoc/>
        [MethodImpl(Compiled.AtOnce)]
        public bool Project(int k, Vector3d[] x)
        {
            _contacts.Project(k, x);
            return true;
        }

        /// <inheritdoc/>
        public void AddImpulses(Vector3d[] impulses)
        {
            _contacts.AddImpulses(impulses);
        }

        /// <inheritdoc/>
        public double Penetration(Vector3d[] x)
        {
            return _deepest;
        }
    }
}
