using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Reflection.Metadata;
using System.Reflection.PortableExecutable;
using NUnit.Framework;

namespace Guidewire.Unity.Tests
{
    /// <summary>Unity may compile editor-only assemblies against the profile of .NET Framework 4.8. One call that it
    /// lacks there stops all compilation, so these assemblies call only what the reference assemblies of 4.7.2 have.
    /// </summary>
    [TestFixture]
    public sealed class FrameworkProfileTests
    {
        private static readonly string[] Libraries = { "mscorlib", "System", "System.Core", "System.Numerics" };

        private readonly HashSet<string> _types = new HashSet<string>();
        private readonly HashSet<string> _members = new HashSet<string>();

        [OneTimeSetUp]
        public void ReadFramework()
        {
            foreach (string library in Libraries)
            {
                using var file = new PEReader(File.OpenRead(Path.Combine(Given("FrameworkReferences"), library + ".dll")));
                MetadataReader reader = file.GetMetadataReader();
                foreach (TypeDefinitionHandle handle in reader.TypeDefinitions)
                {
                    ReadType(reader, handle);
                }
            }
        }

        [TestCase("Guidewire.Core.Tests.OldNUnit", "Guidewire.Core.Tests")]
        [TestCase("Guidewire.Unity.Tests.OldNUnit", "Guidewire.Unity.Tests")]
        [TestCase("Guidewire.Editor", "Guidewire.Editor")]
        public void EditorOnlyAssembly_CallsOnlyWhatTheFrameworkHas(string project, string assembly)
        {
            string path = Path.Combine(Stage.Root, "experiments", "headless", project, "bin", Given("Configuration"),
                "netstandard2.1", assembly + ".dll");
            Assert.That(Missing(path), Is.Empty);
        }

        [Test]
        public void ACallThatTheFrameworkLacks_IsSeen()
        {
            string core = Path.Combine(Stage.Root, "experiments", "headless", "Guidewire.Io", "bin",
                Given("Configuration"), "netstandard2.1", "Guidewire.Io.dll");
            Assert.That(Missing(core), Has.Some.Contains("System.Span`1"), "Io is for players and may use it");
        }

        private static string Given(string key)
        {
            return typeof(FrameworkProfileTests).Assembly.GetCustomAttributes<AssemblyMetadataAttribute>()
                .First(given => given.Key == key).Value!;
        }

        private void ReadType(MetadataReader reader, TypeDefinitionHandle handle)
        {
            TypeDefinition type = reader.GetTypeDefinition(handle);
            string name = SignatureNames.Of(reader, handle);
            _types.Add(name);
            foreach (MethodDefinitionHandle member in type.GetMethods())
            {
                MethodDefinition method = reader.GetMethodDefinition(member);
                _members.Add(name + "::" + SignatureNames.Of(reader.GetString(method.Name),
                    method.DecodeSignature(new SignatureNames(), null)));
            }
            foreach (FieldDefinitionHandle field in type.GetFields())
            {
                _members.Add(name + "::" + reader.GetString(reader.GetFieldDefinition(field).Name));
            }
        }

        /// <summary>Types and members of the base library that an assembly names and the framework does not have.
        /// </summary>
        private List<string> Missing(string path)
        {
            using var file = new PEReader(File.OpenRead(path));
            MetadataReader reader = file.GetMetadataReader();
            var missing = new List<string>();
            foreach (TypeReferenceHandle handle in reader.TypeReferences)
            {
                if (IsLibrary(reader, handle) && !_types.Contains(SignatureNames.Of(reader, handle)))
                {
                    missing.Add(SignatureNames.Of(reader, handle));
                }
            }
            foreach (MemberReferenceHandle handle in reader.MemberReferences)
            {
                MemberReference member = reader.GetMemberReference(handle);
                string? owner = Owner(reader, member.Parent);
                if (owner == null || !_types.Contains(owner))
                {
                    continue;
                }
                string name = reader.GetString(member.Name);
                string whole = owner + "::" + (member.GetKind() == MemberReferenceKind.Field ? name
                    : SignatureNames.Of(name, member.DecodeMethodSignature(new SignatureNames(), null)));
                if (!_members.Contains(whole))
                {
                    missing.Add(whole);
                }
            }
            return missing;
        }

        /// <summary>The generic definition or plain type that a member belongs to; null for arrays and own types.
        /// </summary>
        private static string? Owner(MetadataReader reader, EntityHandle parent)
        {
            if (parent.Kind == HandleKind.TypeReference)
            {
                return IsLibrary(reader, (TypeReferenceHandle)parent)
                    ? SignatureNames.Of(reader, (TypeReferenceHandle)parent) : null;
            }
            if (parent.Kind != HandleKind.TypeSpecification)
            {
                return null;
            }
            string whole = reader.GetTypeSpecification((TypeSpecificationHandle)parent)
                .DecodeSignature(new SignatureNames(), null);
            return whole.EndsWith(']') ? null : whole.Split('<')[0];
        }

        private static bool IsLibrary(MetadataReader reader, TypeReferenceHandle handle)
        {
            EntityHandle scope = reader.GetTypeReference(handle).ResolutionScope;
            return scope.Kind == HandleKind.TypeReference ? IsLibrary(reader, (TypeReferenceHandle)scope)
                : scope.Kind == HandleKind.AssemblyReference && reader.GetString(reader.GetAssemblyReference(
                    (AssemblyReferenceHandle)scope).Name) == "netstandard";
        }
    }
}
