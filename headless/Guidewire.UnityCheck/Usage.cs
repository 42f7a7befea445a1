using System.Runtime.CompilerServices;

namespace Guidewire.UnityCheck
{
    /// <summary>Which names stand in which source, for what is called by its name.</summary>
    internal sealed class Usage
    {
        private static readonly ConditionalWeakTable<SyntaxTree, Dictionary<string, int>> Names =
            new ConditionalWeakTable<SyntaxTree, Dictionary<string, int>>();

        private readonly List<SyntaxTree> _trees;
        private readonly HashSet<string> _events;

        public Usage(IEnumerable<CSharpCompilation> compilations, IEnumerable<string> events)
        {
            _trees = compilations.SelectMany(compilation => compilation.SyntaxTrees).Distinct().ToList();
            _events = new HashSet<string>(events);
        }

        /// <summary>Whether anything but its declaration names a member.</summary>
        /// <param name="home">The source that declares it.</param>
        /// <param name="name">Its name.</param>
        /// <param name="everywhere">Whether other sources may call it; a text with its name counts in any.</param>
        public bool IsNamed(SyntaxTree home, string name, bool everywhere)
        {
            return _events.Contains(name) || Count(home, name) + Count(home, Quoted(name)) > 1
                || _trees.Any(tree => tree != home && (Count(tree, Quoted(name)) > 0
                    || (everywhere && Count(tree, name) > 0)));
        }

        /// <summary>Whether any source declares or names a member.</summary>
        public bool IsKnown(string name)
        {
            return _trees.Any(tree => Count(tree, name) > 0);
        }

        private static int Count(SyntaxTree tree, string name)
        {
            return Names.GetValue(tree, Read).TryGetValue(name, out int count) ? count : 0;
        }

        private static string Quoted(string name)
        {
            return "\"" + name;
        }

        private static Dictionary<string, int> Read(SyntaxTree tree)
        {
            var found = new Dictionary<string, int>();
            foreach (SyntaxToken token in tree.GetRoot().DescendantTokens())
            {
                string? name = token.IsKind(SyntaxKind.IdentifierToken) ? token.ValueText
                    : token.IsKind(SyntaxKind.StringLiteralToken) ? Quoted(token.ValueText) : null;
                if (name != null)
                {
                    found[name] = found.TryGetValue(name, out int count) ? count + 1 : 1;
                }
            }
            return found;
        }
    }
}
