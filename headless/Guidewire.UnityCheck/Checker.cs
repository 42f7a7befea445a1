using Guidewire.UnityCheck.Rules;

namespace Guidewire.UnityCheck
{
    /// <summary>Compiles the assemblies of a project and holds every rule against their sources.</summary>
    internal sealed class Checker
    {
        /// <summary>Largest number of errors reported of one source; more say nothing new.</summary>
        private const int MaxErrors = 20;

        private readonly Sources _sources = new Sources();

        public Reply Check(Request request)
        {
            var reply = new Reply();
            Dictionary<string, CSharpCompilation> compilations = _sources.Compile(request);
            var usage = new Usage(compilations.Values);
            foreach (AssemblyForm form in request.Assemblies)
            {
                CSharpCompilation compilation = compilations[form.Name];
                foreach (SyntaxTree tree in compilation.SyntaxTrees)
                {
                    bool isJudged = request.Only == null || request.Only.Contains(tree.FilePath);
                    bool isTold = form.HasEngine && !form.IsTest;
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
                        SourceTable.Add(source, request.Words, reply);
                    }
                }
            }
            return reply;
        }

        private static void CheckSource(Source source, Reply reply)
        {
            foreach (Diagnostic error in source.Model.GetDiagnostics()
                .Where(error => error.Severity == DiagnosticSeverity.Error).Take(MaxErrors))
            {
                reply.Violations.Add(new Violation(source.Path, Source.Line(error.Location), error.Id,
                    error.GetMessage(System.Globalization.CultureInfo.InvariantCulture)));
            }
            LibraryRules.Check(source);
            ScriptRules.Check(source);
            FieldRules.Check(source);
            MessageRules.Check(source);
        }
    }
}
