using System;
using System.Collections.Immutable;
using System.Linq;
using System.Reflection.Metadata;
using System.Reflection.PortableExecutable;

namespace Guidewire.Unity.Tests
{
    /// <summary>The types and members of Unity's that a compiled assembly names, each with its signature. What the
    /// compiler leaves no name of, constants of enumerations and attributes of the compiler's own, is not among
    /// them.</summary>
    internal sealed class UnityMembers : ISignatureTypeProvider<string, object?>
    {
        private const string Stubs = "UnityStubs";

        /// <summary>The names of an assembly, one a line.</summary>
        public static IEnumerable<string> Of(string file)
        {
            using var stream = File.OpenRead(file);
            using var image = new PEReader(stream);
            MetadataReader reader = image.GetMetadataReader();
            var names = new SortedSet<string>(StringComparer.Ordinal);
            var provider = new UnityMembers();
            foreach (TypeReferenceHandle handle in reader.TypeReferences)
            {
                if (IsUnitys(reader, handle))
                {
                    names.Add(provider.GetTypeFromReference(reader, handle, 0));
                }
            }
            foreach (MemberReferenceHandle handle in reader.MemberReferences)
            {
                MemberReference member = reader.GetMemberReference(handle);
                if (member.Parent.Kind == HandleKind.TypeReference
                    && IsUnitys(reader, (TypeReferenceHandle)member.Parent))
                {
                    names.Add(Text(reader, provider, member));
                }
            }
            return names;
        }

        private static string Text(MetadataReader reader, UnityMembers provider, in MemberReference member)
        {
            string owner = provider.GetTypeFromReference(reader, (TypeReferenceHandle)member.Parent, 0);
            string name = owner + "." + reader.GetString(member.Name);
            if (member.GetKind() == MemberReferenceKind.Field)
            {
                return name + " : " + member.DecodeFieldSignature(provider, null);
            }
            MethodSignature<string> method = member.DecodeMethodSignature(provider, null);
            string generic = method.GenericParameterCount > 0 ? "<" + method.GenericParameterCount + ">" : "";
            return (method.Header.IsInstance ? "" : "static ") + name + generic + "("
                + string.Join(", ", method.ParameterTypes) + ") : " + method.ReturnType;
        }

        private static bool IsUnitys(MetadataReader reader, TypeReferenceHandle handle)
        {
            EntityHandle scope = reader.GetTypeReference(handle).ResolutionScope;
            return scope.Kind == HandleKind.AssemblyReference
                ? reader.GetString(reader.GetAssemblyReference((AssemblyReferenceHandle)scope).Name) == Stubs
                : scope.Kind == HandleKind.TypeReference && IsUnitys(reader, (TypeReferenceHandle)scope);
        }

        public string GetTypeFromReference(MetadataReader reader, TypeReferenceHandle handle, byte rawTypeKind)
        {
            TypeReference type = reader.GetTypeReference(handle);
            return reader.GetString(type.Namespace) + "." + reader.GetString(type.Name);
        }

        public string GetTypeFromDefinition(MetadataReader reader, TypeDefinitionHandle handle, byte rawTypeKind)
        {
            TypeDefinition type = reader.GetTypeDefinition(handle);
            return reader.GetString(type.Namespace) + "." + reader.GetString(type.Name);
        }

        public string GetTypeFromSpecification(MetadataReader reader, object? context, TypeSpecificationHandle handle,
            byte rawTypeKind)
        {
            return reader.GetTypeSpecification(handle).DecodeSignature(this, context);
        }

        public string GetPrimitiveType(PrimitiveTypeCode typeCode) => typeCode.ToString();

        public string GetSZArrayType(string elementType) => elementType + "[]";

        public string GetArrayType(string elementType, ArrayShape shape) => elementType + "[,]";

        public string GetByReferenceType(string elementType) => "ref " + elementType;

        public string GetPointerType(string elementType) => elementType + "*";

        public string GetPinnedType(string elementType) => elementType;

        public string GetFunctionPointerType(MethodSignature<string> signature) => "method*";

        public string GetGenericMethodParameter(object? context, int index) => "T" + index;

        public string GetGenericTypeParameter(object? context, int index) => "T" + index;

        public string GetModifiedType(string modifier, string unmodifiedType, bool isRequired) => unmodifiedType;

        public string GetGenericInstantiation(string genericType, ImmutableArray<string> typeArguments)
        {
            return genericType + "<" + string.Join(", ", typeArguments) + ">";
        }
    }
}
