#if !NET5_0_OR_GREATER
namespace System.Diagnostics.CodeAnalysis
{
    /// <summary>Tells .NET's linker what a method needs that no code names; netstandard2.1 has no such attribute, and
    /// the linker knows it by its name.</summary>
    [AttributeUsage(AttributeTargets.Method, AllowMultiple = true)]
    internal sealed class DynamicDependencyAttribute : Attribute
    {
        public DynamicDependencyAttribute(DynamicallyAccessedMemberTypes memberTypes, Type type)
        {
            MemberTypes = memberTypes;
            Type = type;
        }

        public DynamicallyAccessedMemberTypes MemberTypes { get; }

        public Type Type { get; }
    }

    /// <summary>Of .NET's members by the same names, what is needed here.</summary>
    [Flags]
    internal enum DynamicallyAccessedMemberTypes
    {
        PublicProperties = 0x0200,
        NonPublicProperties = 0x0400,
    }
}
#endif
