using System.Collections.Immutable;
using System.Reflection.Metadata;

namespace Guidewire.Unity.Tests
{
    /// <summary>Types of signatures as text, the same for a definition and a reference to it.</summary>
    internal sealed class SignatureNames : ISignatureTypeProvider<string, object?>
    {
        /// <summary>Namespace and name; a nested type behind its outer one.</summary>
        public static string Of(MetadataReader reader, TypeDefinitionHandle handle)
        {
            TypeDefinition type = reader.GetTypeDefinition(handle);
            string name = reader.GetString(type.Name);
            TypeDefinitionHandle outer = type.GetDeclaringType();
            return outer.IsNil ? Join(reader.GetString(type.Namespace), name) : Of(reader, outer) + "/" + name;
        }

        /// <summary>Namespace and name; a nested type behind its outer one.</summary>
        public static string Of(MetadataReader reader, TypeReferenceHandle handle)
        {
            TypeReference type = reader.GetTypeReference(handle);
            string name = reader.GetString(type.Name);
            return type.ResolutionScope.Kind == HandleKind.TypeReference
                ? Of(reader, (TypeReferenceHandle)type.ResolutionScope) + "/" + name
                : Join(reader.GetString(type.Namespace), name);
        }

        /// <summary>Name, parameters and result.</summary>
        public static string Of(string name, MethodSignature<string> signature)
        {
            return name + "(" + string.Join(",", signature.ParameterTypes) + ")" + signature.ReturnType;
        }

        public string GetArrayType(string elementType, ArrayShape shape) => elementType + "[" + shape.Rank + "]";

        public string GetByReferenceType(string elementType) => elementType + "&";

        public string GetFunctionPointerType(MethodSignature<string> signature) => Of("*", signature);

        public string GetGenericInstantiation(string genericType, ImmutableArray<string> typeArguments) =>
            genericType + "<" + string.Join(",", typeArguments) + ">";

        public string GetGenericMethodParameter(object? genericContext, int index) => "!!" + index;

        public string GetGenericTypeParameter(object? genericContext, int index) => "!" + index;

        public string GetModifiedType(string modifier, string unmodifiedType, bool isRequired) => unmodifiedType;

        public string GetPinnedType(string elementType) => elementType;

        public string GetPointerType(string elementType) => elementType + "*";

        public string GetPrimitiveType(PrimitiveTypeCode typeCode) => "System." + typeCode;

        public string GetSZArrayType(string elementType) => elementType + "[]";

        public string GetTypeFromDefinition(MetadataReader reader, TypeDefinitionHandle handle, byte rawTypeKind) =>
            Of(reader, handle);

        public string GetTypeFromReference(MetadataReader reader, TypeReferenceHandle handle, byte rawTypeKind) =>
            Of(reader, handle);

        public string GetTypeFromSpecification(MetadataReader reader, object? genericContext,
            TypeSpecificationHandle handle, byte rawTypeKind) =>
            reader.GetTypeSpecification(handle).DecodeSignature(this, genericContext);

        private static string Join(string space, string name)
        {
            return space.Length == 0 ? name : space + "." + name;
        }
    }
}
