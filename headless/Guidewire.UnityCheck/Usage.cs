using System.Runtime.CompilerServices;

namespace Guidewire.UnityCheck
{
    /// <summary>Which names stand in which source, for what is called by its name.</summary>
    internal sealed class Usage
    {
        private static readonly ConditionalWeakTable<SyntaxTree, Dictionary<string, int>> Names =
            new ConditionalWeakTable<SyntaxTree, Dictionary<string, int>>();

        private readonly List<SyntaxTree> _trees;

        public Usage(IEnumerable<CSharpCompilation> compilations)
        {
            _trees = compilations.SelectMany(compilation => compilation.SyntaxTrees).Distinct().ToList();
        }

        /// <summary>Whether anything but its declaration names a member, as a name or as a whole text.</summary>
        /// <param name="home">The source that declares it.</param>
        /// <param name="name">Its name.</param>
        /// <param name="everywhere">Whether other sources may call it.</param>
        public bool IsNamed(SyntaxTree home, string name, bool everywhere)
        {
            return Count(home, name) > 1 || (everywhere && _trees.Any(tree => tree != home && Count(tree, name) > 0));
        }

        private static int Count(SyntaxTree tree, string name)
        {
            return Names.GetValue(tree, Read).TryGetValue(name, out int count) ? count : 0;
        }

        private static Dictionary<string, int> Read(SyntaxTree tree)
        {
            return tree.GetRoot().DescendantTokens()
                .Where(token => token.IsKind(SyntaxKind.IdentifierToken) || token.IsKind(SyntaxKind.StringLiteralToken))
                .GroupBy(token => token.ValueText).ToDictionary(same => same.Key, same => same.Count());
        }
    }
}
