namespace Guidewire.UnityCheck.Rules
{
    /// <summary>Tests in Unity: fixtures that its NUnit can make, methods that its runner can call.</summary>
    internal static class FixtureRules
    {
        private static readonly HashSet<string> Tests = new HashSet<string>
            { "Test", "TestCase", "TestCaseSource", "Theory", "UnityTest", "Combinatorial", "Pairwise", "Sequential" };

        private static readonly HashSet<string> Around = new HashSet<string>
            { "SetUp", "TearDown", "OneTimeSetUp", "OneTimeTearDown" };

        private static readonly HashSet<string> Framed = new HashSet<string>
            { "UnityTest", "UnitySetUp", "UnityTearDown" };

        private static readonly HashSet<string> Filling = new HashSet<string>
            { "Values", "ValueSource", "Range", "Random" };

        public static void Check(Source source)
        {
            foreach (INamedTypeSymbol type in source.Types)
            {
                List<IMethodSymbol> marked = source.Members<IMethodSymbol>(type)
                    .Where(method => UnityTypes.Attributes(method)
                    .Any(name => Tests.Contains(name) || Around.Contains(name) || Framed.Contains(name))).ToList();
                if (marked.Count == 0 && !UnityTypes.Has(type, "TestFixture")
                    && !UnityTypes.Has(type, "TestFixtureSource"))
                {
                    continue;
                }
                if (!source.Assembly.IsTest)
                {
                    source.Report(type, "test-assembly", type.Name + " holds tests, " + source.Assembly.Name
                        + " is no test assembly");
                }
                CheckFixture(source, type);
                foreach (IMethodSymbol method in marked)
                {
                    CheckMethod(source, type, method);
                }
            }
        }

        private static void CheckFixture(Source source, INamedTypeSymbol type)
        {
            if (type.IsAbstract)
            {
                return;
            }
            List<AttributeData> given = type.GetAttributes()
                .Where(attribute => UnityTypes.Name(attribute) == "TestFixture")
                .ToList();
            HashSet<int> counts = given.Select(Given).DefaultIfEmpty(0).ToHashSet();
            HashSet<int> takes = type.InstanceConstructors
                .Where(made => made.DeclaredAccessibility == Accessibility.Public)
                .Select(made => made.Parameters.Length)
                .ToHashSet();
            bool fromSource = UnityTypes.Has(type, "TestFixtureSource");
            bool isPlain = counts.SetEquals(new[] { 0 }) && !fromSource;
            string? reason = UnityTypes.IsMadeByUnity(type) ? "is made by Unity, not by the runner"
                : type.ContainingType != null ? "is nested in " + type.ContainingType.Name
                    + ", which Unity's runner does not look into"
                : type.IsGenericType && isPlain ? "is generic and gets no types"
                : type.TypeKind != TypeKind.Class ? "is no class"
                : !fromSource && !type.IsGenericType && !counts.IsSubsetOf(takes)
                    ? "has no public constructor for what TestFixture gives it" : null;
            if (reason != null)
            {
                source.Report(type, "test-fixture", "the fixture " + type.Name + " " + reason);
            }
        }

        /// <summary>How many arguments an attribute gives, those by name left aside.</summary>
        private static int Given(AttributeData attribute)
        {
            return attribute.ApplicationSyntaxReference?.GetSyntax() is AttributeSyntax { ArgumentList: { } list }
                ? list.Arguments.Count(argument => argument.NameEquals == null) : 0;
        }

        private static void CheckMethod(Source source, INamedTypeSymbol type, IMethodSymbol method)
        {
            HashSet<string> names = UnityTypes.Attributes(method).ToHashSet();
            bool isFramed = names.Overlaps(Framed);
            string? reason = method.DeclaredAccessibility != Accessibility.Public ? "must be public"
                : isFramed ? FramedReason(method, names)
                : names.Overlaps(Around) ? (method.Parameters.Length > 0 || !method.ReturnsVoid || method.IsAsync
                    ? "must return void and have no parameters" : null)
                : PlainReason(method, names);
            if (reason != null)
            {
                bool isFrames = method.DeclaredAccessibility == Accessibility.Public
                    && (isFramed || method.ReturnType.Name == "IEnumerator");
                source.Report(method, isFrames ? "unity-test" : "test-method", method.Name + " " + reason);
            }
            else if (names.Overlaps(Tests))
            {
                CheckArguments(source, type, method, names);
            }
        }

        private static string? FramedReason(IMethodSymbol method, HashSet<string> names)
        {
            return method.ReturnType.Name != "IEnumerator" ? "must return IEnumerator, not " + method.ReturnType.Name
                : names.Overlaps(new[] { "TestCase", "TestCaseSource", "Theory" })
                    ? "cannot have cases; ValueSource gives a UnityTest its values"
                : names.Contains("Test") ? "is a Test as well"
                : method.Parameters.Length > 0 && !names.Contains("UnityTest") ? "may have no parameters" : null;
        }

        private static string? PlainReason(IMethodSymbol method, HashSet<string> names)
        {
            bool expects = names.Contains("TestCaseSource") ? !method.ReturnsVoid
                : method.GetAttributes().SelectMany(attribute => attribute.NamedArguments)
                    .Any(pair => pair.Key == "ExpectedResult");
            // Tasks that are awaited came with test framework 1.3; NUnit waits for no method that returns void.
            bool isTask = method.ReturnType.Name == "Task";
            return method.ReturnType.Name == "IEnumerator" ? "yields frames that nobody makes: UnityTest, not Test"
                : method.IsAsync && method.ReturnsVoid ? "is not waited for: it must return a Task"
                : method.IsGenericMethod && !names.Overlaps(new[] { "TestCase", "TestCaseSource" })
                    ? "is generic and gets no types"
                : !method.ReturnsVoid && !isTask && !expects
                    ? "returns " + method.ReturnType.Name + " and expects no result"
                : method.ReturnsVoid && expects ? "expects a result and returns none" : null;
        }

        private static void CheckArguments(Source source, INamedTypeSymbol type, IMethodSymbol method,
            HashSet<string> names)
        {
            int count = method.Parameters.Length;
            bool isOpen = count > 0 && method.Parameters[count - 1].Type is IArrayTypeSymbol;
            foreach (AttributeData attribute in method.GetAttributes())
            {
                string name = UnityTypes.Name(attribute);
                int given = name == "TestCase" ? Given(attribute) : count;
                if (given != count && !(isOpen && given >= count - 1))
                {
                    source.Report(method, "test-method", method.Name + " has " + count + " parameters, its case "
                        + given);
                }
                CheckSource(source, type, method, attribute);
            }
            foreach (AttributeData attribute in method.Parameters.SelectMany(parameter => parameter.GetAttributes()))
            {
                CheckSource(source, type, method, attribute);
            }
            bool isFilled = names.Contains("TestCase") || names.Contains("TestCaseSource") || names.Contains("Theory")
                || method.Parameters.All(parameter => UnityTypes.Attributes(parameter).Any(Filling.Contains));
            if (!isFilled)
            {
                source.Report(method, "test-method", method.Name + " has parameters and nothing that fills them");
            }
        }

        /// <summary>A source of cases or values must be a static member.</summary>
        private static void CheckSource(Source source, INamedTypeSymbol type, IMethodSymbol method,
            AttributeData attribute)
        {
            string kind = UnityTypes.Name(attribute);
            if (kind != "TestCaseSource" && kind != "ValueSource")
            {
                return;
            }
            ITypeSymbol home = attribute.ConstructorArguments.Select(argument => argument.Value).OfType<ITypeSymbol>()
                .FirstOrDefault() ?? type;
            // A name that does not exist is an error of the compiler's in nameof, and has no value then.
            string? name = attribute.ConstructorArguments.Select(argument => argument.Value).OfType<string>()
                .FirstOrDefault();
            if (name == null)
            {
                return;
            }
            ISymbol? member = UnityTypes.Chain(home).SelectMany(above => above.GetMembers(name)).FirstOrDefault();
            if (member == null)
            {
                source.Report(method, "test-method", method.Name + ": there is no source " + name);
            }
            else if (!member.IsStatic)
            {
                source.Report(method, "test-method", method.Name + ": its source " + name + " must be static");
            }
        }
    }
}
