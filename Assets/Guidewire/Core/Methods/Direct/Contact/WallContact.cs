namespace Guidewire.Core
{
    /// <summary>A contact force of a wall on the wire: on element j at s, which is one of its nodes at 0 and
    /// 1.</summary>
    internal readonly struct WallContact
    {
        /// <summary>Index in the list of walls.</summary>
        public readonly int Wall;

        /// <summary>The element j.</summary>
        public readonly int Element;

        /// <summary>The position s along it.</summary>
        public readonly double Position;

        /// <summary>Whether a node touches, else the interior of the element.</summary>
        public readonly bool IsNode;

        /// <summary>Unit normal, the direction of the force.</summary>
        public readonly Vector3d Normal;

        /// <summary>The normal force, N.</summary>
        public readonly double Force;

        /// <summary>By how much the wall gives way there, m.</summary>
        public readonly double Displacement;

        /// <summary>Makes a contact with these values.</summary>
        public WallContact(int wall, int element, double position, in Vector3d force, bool isNode, double displacement)
        {
            Displacement = displacement;
            IsNode = isNode;
            Wall = wall;
            Element = element;
            Position = position;
            Force = force.Length;
            Normal = Vector3d.Normalize(force);
        }
    }
}
