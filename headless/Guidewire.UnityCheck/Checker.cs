using Guidewire.UnityCheck.Rules;

namespace Guidewire.UnityCheck
{
    /// <summary>Compiles the assemblies of a project and holds every rule against their sources.</summary>
    internal sealed class Checker
    {
        /// <summary>Largest number of errors reported of one source; more say nothing new.</summary>
        private const int MostErrors = 20;

        private readonly Sources _sources = new Sources();

        public Reply Check(Request request)
        {
            var reply = new Reply();
            Dictionary<string, CSharpCompilation> compilations = _sources.Compile(request);
            var usage = new Usage(compilations.Values, request.Events);
            HashSet<string>? only = request.Only == null ? null : new HashSet<string>(request.Only);
            foreach (AssemblyForm form in request.Assemblies)
            {
                if (!compilations.TryGetValue(form.Name, out CSharpCompilation? compilation))
                {
                    continue;
                }
                bool isTold = !form.IsTest && form.HasEngine;
                foreach (SyntaxTree tree in compilation.SyntaxTrees)
                {
                    bool isJudged = only == null || only.Contains(tree.FilePath);
                    if (!isJudged && !isTold)
                    {
                        continue;
                    }
                    var source = new Source(form, compilation, tree, usage, reply);
                    if (isJudged)
                    {
                        CheckSource(source, reply);
                    }
                    if (isTold)
                    {
                        SourceTable.Add(source, reply);
                    }
                    CallTable.Add(source, request.Words, reply);
                }
            }
            return reply;
        }

        private static bool IsFriendly(string attribute)
        {
            return attribute.StartsWith("InternalsVisibleTo", StringComparison.Ordinal);
        }

        private static void CheckSource(Source source, Reply reply)
        {
            foreach (Diagnostic error in source.Model.GetDiagnostics()
                .Where(error => error.Severity == DiagnosticSeverity.Error).Take(MostErrors))
            {
                reply.Violations.Add(new Violation(source.Path, Source.Line(error.Location), error.Id,
                    error.GetMessage(System.Globalization.CultureInfo.InvariantCulture)));
            }
            reply.Friends.AddRange(source.Root.DescendantNodes().OfType<AttributeSyntax>()
                .Where(attribute => IsFriendly(attribute.Name.ToString()))
                .SelectMany(attribute => attribute.DescendantNodes().OfType<LiteralExpressionSyntax>())
                .Select(text => new Word(source.Path, Source.Line(text.GetLocation()), text.Token.ValueText)));
            LibraryRules.Check(source);
            ScriptRules.Check(source);
            FieldRules.Check(source);
            MessageRules.Check(source);
            EditorRules.Check(source);
            FixtureRules.Check(source);
        }
    }
}
