using System.IO;
using System.Runtime.CompilerServices;
using System.Text;
using Microsoft.CodeAnalysis.Text;

namespace Guidewire.UnityCheck
{
    /// <summary>Syntax trees and compilations, kept from one request to the next: what did not change is not bound
    /// again.</summary>
    internal sealed class Sources
    {
        private static readonly string[] Editor =
        {
            "UNITY_EDITOR", "UNITY_EDITOR_64", "UNITY_6000_0", "UNITY_6000_0_OR_NEWER", "UNITY_5_3_OR_NEWER",
            "UNITY_64",
            "UNITY_STANDALONE", "UNITY_INCLUDE_TESTS", "ENABLE_LEGACY_INPUT_MANAGER", "NETSTANDARD", "NETSTANDARD2_1",
            "NET_STANDARD", "NET_STANDARD_2_1", "CSHARP_7_3_OR_NEWER", "DEBUG", "TRACE",
        };

        private static readonly CSharpParseOptions InEditor =
            CSharpParseOptions.Default.WithLanguageVersion(LanguageVersion.CSharp9).WithPreprocessorSymbols(Editor);

        private static readonly CSharpParseOptions InPlayer =
            InEditor.WithPreprocessorSymbols(Editor.Where(
                symbol => !symbol.StartsWith("UNITY_EDITOR", StringComparison.Ordinal)));

        private readonly Dictionary<string, (DateTime Time, SyntaxTree Tree)> _files =
            new Dictionary<string, (DateTime, SyntaxTree)>();

        private readonly Dictionary<string, CSharpCompilation> _compilations =
            new Dictionary<string, CSharpCompilation>();

        private readonly ConditionalWeakTable<CSharpCompilation, MetadataReference> _references =
            new ConditionalWeakTable<CSharpCompilation, MetadataReference>();

        /// <summary>The tree of a source as the editor compiles it.</summary>
        public SyntaxTree Tree(Request request, string path)
        {
            if (request.Changes.TryGetValue(path, out string? text))
            {
                return Parse(text, path, InEditor);
            }
            string file = Path.Combine(request.Root, path);
            DateTime time = File.GetLastWriteTimeUtc(file);
            if (!_files.TryGetValue(file, out (DateTime Time, SyntaxTree Tree) known) || known.Time != time)
            {
                known = (time, Parse(File.ReadAllText(file), path, InEditor));
                _files[file] = known;
            }
            return known.Tree;
        }

        /// <summary>Gives the same source as a player's compiler sees it.</summary>
        public static SyntaxTree ForPlayer(SyntaxTree tree)
        {
            return tree.WithRootAndOptions(Parse(tree.ToString(), tree.FilePath, InPlayer).GetRoot(), InPlayer);
        }

        /// <summary>Gives the compilations of a request's assemblies by name.</summary>
        public Dictionary<string, CSharpCompilation> Compile(Request request)
        {
            var made = new Dictionary<string, CSharpCompilation>();
            var open = new HashSet<string>();
            foreach (AssemblyForm form in request.Assemblies)
            {
                Compile(request, form, made, open);
            }
            return made;
        }

        private void Compile(Request request, AssemblyForm form, Dictionary<string, CSharpCompilation> made,
            HashSet<string> open)
        {
            if (made.ContainsKey(form.Name) || !open.Add(form.Name))
            {
                return;
            }
            List<MetadataReference> references = Libraries.Standard.ToList();
            if (form.HasEngine)
            {
                references.Add(Libraries.UnityStubs);
            }
            references.AddRange(form.Libraries.Select(Libraries.Find).OfType<MetadataReference>());
            foreach (string name in form.References)
            {
                AssemblyForm? other = request.Assemblies.FirstOrDefault(candidate => candidate.Name == name);
                if (other != null && other != form)
                {
                    Compile(request, other, made, open);
                    if (made.TryGetValue(name, out CSharpCompilation? compiled))
                    {
                        references.Add(Reference(compiled));
                    }
                }
            }
            made[form.Name] = Update(request, form, references);
        }

        private CSharpCompilation Update(Request request, AssemblyForm form, List<MetadataReference> references)
        {
            var options = new CSharpCompilationOptions(OutputKind.DynamicallyLinkedLibrary,
                allowUnsafe: form.IsUnsafeAllowed, nullableContextOptions: NullableContextOptions.Annotations,
                concurrentBuild: false);
            List<SyntaxTree> trees = form.Files.Select(path => Tree(request, path)).ToList();
            string key = request.Root + "|" + form.Name;
            if (!_compilations.TryGetValue(key, out CSharpCompilation? last))
            {
                last = CSharpCompilation.Create(form.Name, trees, references, options);
            }
            var asked = new HashSet<SyntaxTree>(trees);
            List<SyntaxTree> gone = last.SyntaxTrees.Where(tree => !asked.Contains(tree)).ToList();
            asked.ExceptWith(last.SyntaxTrees);
            if (gone.Count > 0 || asked.Count > 0)
            {
                last = last.RemoveSyntaxTrees(gone).AddSyntaxTrees(trees.Where(asked.Contains));
            }
            if (!last.References.SequenceEqual(references))
            {
                last = last.WithReferences(references);
            }
            if (last.Options.AllowUnsafe != options.AllowUnsafe)
            {
                last = last.WithOptions(options);
            }
            // What a request changed does not stay: the next one starts from the files again.
            if (request.Changes.Count == 0)
            {
                _compilations[key] = last;
            }
            return last;
        }

        private MetadataReference Reference(CSharpCompilation compilation)
        {
            return _references.GetValue(compilation, key => key.ToMetadataReference());
        }

        private static SyntaxTree Parse(string text, string path, CSharpParseOptions options)
        {
            return CSharpSyntaxTree.ParseText(SourceText.From(text, Encoding.UTF8), options, path);
        }
    }
}
