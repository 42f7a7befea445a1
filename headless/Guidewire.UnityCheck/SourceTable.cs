using Guidewire.UnityCheck.Rules;

namespace Guidewire.UnityCheck
{
    /// <summary>What scenes, command lines and the manifest need to know of the sources that use the engine.</summary>
    internal static class SourceTable
    {
        public static void Add(Source source, IReadOnlyCollection<string> words, Reply reply)
        {
            foreach (INamedTypeSymbol type in source.Types)
            {
                if (UnityTypes.IsBehaviour(type) && type.Name == source.Stem && !source.Assembly.IsEditorOnly)
                {
                    reply.Scripts[source.Path] = FieldRules.Stored(type).SelectMany(Names).ToArray();
                }
                if (source.Assembly.IsEditorOnly)
                {
                    reply.Entries.AddRange(source.Members<IMethodSymbol>(type)
                        .Where(method => method.IsStatic && method.Parameters.Length == 0 && !method.IsGenericMethod
                            && type.GetMembers(method.Name).Length == 1)
                        .Select(method => type.ToDisplayString() + "." + method.Name));
                }
            }
            reply.Words.AddRange(source.Root.DescendantTokens()
                .Where(token => token.IsKind(SyntaxKind.IdentifierToken) && words.Contains(token.ValueText))
                .Select(token => new Word(source.Path, Source.Line(token.GetLocation()), token.ValueText)));
        }

        private static IEnumerable<string> Names(IFieldSymbol field)
        {
            return field.GetAttributes().Where(attribute => UnityTypes.Name(attribute) == "FormerlySerializedAs")
                .SelectMany(attribute => attribute.ConstructorArguments).Select(argument => argument.Value as string)
                .OfType<string>().Append(field.Name);
        }
    }
}
