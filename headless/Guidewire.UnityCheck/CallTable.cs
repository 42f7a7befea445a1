namespace Guidewire.UnityCheck
{
    /// <summary>Words and calls whose meaning stands in assets and settings, which the compiler does not
    /// read.</summary>
    internal static class CallTable
    {
        public static void Add(Source source, IReadOnlyCollection<string> words, Reply reply)
        {
            if (!source.Assembly.HasEngine)
            {
                return;
            }
            foreach (SyntaxToken token in source.Root.DescendantTokens())
            {
                if (token.IsKind(SyntaxKind.IdentifierToken) && words.Contains(token.ValueText))
                {
                    reply.Words.Add(new Word(source.Path, Source.Line(token.GetLocation()), token.ValueText));
                }
            }
            foreach (InvocationExpressionSyntax call in source.Root.DescendantNodes()
                .OfType<InvocationExpressionSyntax>())
            {
                ExpressionSyntax? first = call.ArgumentList.Arguments.FirstOrDefault()?.Expression;
                if (first is LiteralExpressionSyntax literal && literal.IsKind(SyntaxKind.StringLiteralExpression))
                {
                    string owner = call.Expression is MemberAccessExpressionSyntax access
                        ? access.Expression.ToString().Split('.').Last() : "";
                    reply.Calls.Add(new Call(source.Path, Source.Line(call.GetLocation()), owner, CalledName(call),
                        literal.Token.ValueText));
                }
            }
        }

        /// <summary>The bare name of the method that is called; empty where there is none.</summary>
        public static string CalledName(InvocationExpressionSyntax call)
        {
            return call.Expression switch
            {
                MemberAccessExpressionSyntax access => access.Name.Identifier.ValueText,
                MemberBindingExpressionSyntax binding => binding.Name.Identifier.ValueText,
                SimpleNameSyntax name => name.Identifier.ValueText,
                _ => "",
            };
        }
    }
}
