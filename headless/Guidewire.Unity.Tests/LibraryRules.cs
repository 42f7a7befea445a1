using System;
using System.Linq;
using System.Reflection;
using System.Reflection.Metadata;
using System.Reflection.PortableExecutable;

namespace Guidewire.Unity.Tests
{
    /// <summary>Members of .NET and NUnit that a built assembly uses, and those that a library has, each as
    /// Type.Name(types): what compiles here and not in Unity is the difference.</summary>
    internal static class LibraryRules
    {
        /// <summary>The members that a library shows to others.</summary>
        public static HashSet<string> Members(params string[] files)
        {
            var found = new HashSet<string>();
            foreach (string file in files)
            {
                using var image = new PEReader(File.OpenRead(file));
                MetadataReader reader = image.GetMetadataReader();
                foreach (TypeDefinition type in reader.TypeDefinitions.Select(reader.GetTypeDefinition))
                {
                    string name = NameOf(reader, type);
                    found.Add(name);
                    found.UnionWith(type.GetMethods().Select(reader.GetMethodDefinition)
                        .Where(one => (one.Attributes & MethodAttributes.MemberAccessMask) >= MethodAttributes.Family)
                        .Select(one => name + "." + reader.GetString(one.Name) + Types(reader, one.Signature)));
                    found.UnionWith(type.GetFields().Select(reader.GetFieldDefinition)
                        .Select(one => name + "." + reader.GetString(one.Name) + Types(reader, one.Signature)));
                }
            }
            return found;
        }

        /// <summary>The types and members of other libraries that an assembly uses.</summary>
        /// <param name="file">The assembly.</param>
        /// <param name="library">Begin of the names of these libraries.</param>
        public static SortedSet<string> Used(string file, string library)
        {
            var found = new SortedSet<string>(StringComparer.Ordinal);
            using var image = new PEReader(File.OpenRead(file));
            MetadataReader reader = image.GetMetadataReader();
            foreach (TypeReferenceHandle handle in reader.TypeReferences.Where(one => IsOf(reader, one, library)))
            {
                found.Add(NameOf(reader, handle));
            }
            foreach (MemberReference member in reader.MemberReferences.Select(reader.GetMemberReference))
            {
                EntityHandle parent = member.Parent;
                if (parent.Kind == HandleKind.TypeSpecification)
                {
                    BlobReader blob = reader.GetBlobReader(reader.GetTypeSpecification(
                        (TypeSpecificationHandle)parent).Signature);
                    if (blob.ReadSignatureTypeCode() != SignatureTypeCode.GenericTypeInstance)
                    {
                        continue;
                    }
                    blob.ReadCompressedInteger();
                    parent = blob.ReadTypeHandle();
                }
                if (parent.Kind == HandleKind.TypeReference && IsOf(reader, (TypeReferenceHandle)parent, library))
                {
                    found.Add(NameOf(reader, parent) + "." + reader.GetString(member.Name)
                        + Types(reader, member.Signature));
                }
            }
            return found;
        }

        private static bool IsOf(MetadataReader reader, TypeReferenceHandle handle, string library)
        {
            EntityHandle scope = reader.GetTypeReference(handle).ResolutionScope;
            return scope.Kind == HandleKind.TypeReference ? IsOf(reader, (TypeReferenceHandle)scope, library)
                : scope.Kind == HandleKind.AssemblyReference && reader.GetString(reader.GetAssemblyReference(
                    (AssemblyReferenceHandle)scope).Name).StartsWith(library, StringComparison.Ordinal);
        }

        private static string NameOf(MetadataReader reader, TypeDefinition type)
        {
            string name = reader.GetString(type.Name);
            return type.IsNested ? NameOf(reader, reader.GetTypeDefinition(type.GetDeclaringType())) + "+" + name
                : reader.GetString(type.Namespace) + "." + name;
        }

        private static string NameOf(MetadataReader reader, EntityHandle handle)
        {
            if (handle.Kind == HandleKind.TypeDefinition)
            {
                return NameOf(reader, reader.GetTypeDefinition((TypeDefinitionHandle)handle));
            }
            TypeReference type = reader.GetTypeReference((TypeReferenceHandle)handle);
            string name = reader.GetString(type.Name);
            return type.ResolutionScope.Kind == HandleKind.TypeReference
                ? NameOf(reader, type.ResolutionScope) + "+" + name : reader.GetString(type.Namespace) + "." + name;
        }

        /// <summary>The types of a method's parameters; of a field nothing.</summary>
        private static string Types(MetadataReader reader, BlobHandle signature)
        {
            BlobReader blob = reader.GetBlobReader(signature);
            SignatureHeader header = blob.ReadSignatureHeader();
            if (header.Kind != SignatureKind.Method)
            {
                return "";
            }
            if (header.IsGeneric)
            {
                blob.ReadCompressedInteger();
            }
            int count = blob.ReadCompressedInteger();
            Next(reader, ref blob);    // what it returns
            var types = new string[count];
            for (int i = 0; i < count; i++)
            {
                types[i] = Next(reader, ref blob);
            }
            return "(" + string.Join(",", types) + ")";
        }

        /// <summary>Reads one type of a signature (ECMA-335, II.23.2.12).</summary>
        private static string Next(MetadataReader reader, ref BlobReader blob)
        {
            SignatureTypeCode code = blob.ReadSignatureTypeCode();
            switch (code)
            {
                case SignatureTypeCode.TypeHandle:
                    return NameOf(reader, blob.ReadTypeHandle());
                case SignatureTypeCode.SZArray:
                case SignatureTypeCode.Pointer:
                case SignatureTypeCode.ByReference:
                    return Next(reader, ref blob) + code;
                case SignatureTypeCode.RequiredModifier:
                case SignatureTypeCode.OptionalModifier:
                    blob.ReadTypeHandle();
                    return Next(reader, ref blob);
                case SignatureTypeCode.GenericTypeParameter:
                case SignatureTypeCode.GenericMethodParameter:
                    return code.ToString() + blob.ReadCompressedInteger();
                case SignatureTypeCode.GenericTypeInstance:
                    string text = Next(reader, ref blob);
                    for (int left = blob.ReadCompressedInteger(); left > 0; left--)
                    {
                        text += "," + Next(reader, ref blob);
                    }
                    return text + ">";
                case SignatureTypeCode.Array:
                    string element = Next(reader, ref blob) + code + blob.ReadCompressedInteger();
                    for (int part = 0; part < 2; part++)
                    {
                        for (int left = blob.ReadCompressedInteger(); left > 0; left--)
                        {
                            blob.ReadCompressedInteger();
                        }
                    }
                    return element;
                default:
                    return code.ToString();
            }
        }
    }
}
