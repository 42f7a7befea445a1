using Guidewire.UnityCheck.Rules;

namespace Guidewire.UnityCheck
{
    /// <summary>What scenes, menus and command lines need to know of the player's and the editor's sources.</summary>
    internal static class SourceTable
    {
        private static readonly SymbolDisplayFormat Short = SymbolDisplayFormat.MinimallyQualifiedFormat
            .WithMiscellaneousOptions(SymbolDisplayMiscellaneousOptions.UseSpecialTypes);

        public static void Add(Source source, Reply reply)
        {
            foreach (INamedTypeSymbol type in source.Types)
            {
                if (UnityTypes.IsMadeByUnity(type) && type.Name == source.Stem && type.ContainingType == null)
                {
                    reply.Scripts[source.Path] = new Script(type.Name, UnityTypes.IsBehaviour(type),
                        source.Assembly.IsEditorOnly, UnityTypes.Chain(type).Select(above => above.Name).ToArray(),
                        FieldRules.Stored(type).ToDictionary(field => field.Name, Field));
                }
                foreach (IMethodSymbol method in source.Members<IMethodSymbol>(type))
                {
                    Add(source, method, reply);
                }
                reply.Markers.AddRange(source.Members<IFieldSymbol>(type)
                    .Where(field => field.Name == "Marker" && field.IsConst)
                    .Select(field => field.ConstantValue as string)
                    .OfType<string>());
            }
        }

        private static void Add(Source source, IMethodSymbol method, Reply reply)
        {
            if (method.MethodKind != MethodKind.Ordinary)
            {
                return;
            }
            string name = method.ContainingType.ToDisplayString(SymbolDisplayFormat.CSharpErrorMessageFormat) + "."
                + method.Name;
            if (!reply.Methods.TryGetValue(name, out List<Method>? methods))
            {
                methods = new List<Method>();
                reply.Methods[name] = methods;
            }
            methods.Add(new Method(source.Path, source.Line(method), method.IsStatic, method.Parameters.Length > 0,
                method.IsGenericMethod));
            reply.Menus.AddRange(method.GetAttributes().Where(attribute => UnityTypes.Name(attribute) == "MenuItem")
                .Select(EditorRules.MenuPath).OfType<string>());
        }

        private static StoredField Field(IFieldSymbol field)
        {
            ITypeSymbol type = FieldRules.Element(field.Type);
            bool isEnum = type.TypeKind == TypeKind.Enum;
            string kind = FieldRules.IsNumber(type) ? "number" : type.SpecialType == SpecialType.System_Boolean ? "bool"
                : type.SpecialType == SpecialType.System_String || type.SpecialType == SpecialType.System_Char ? "text"
                : isEnum ? "enum" : UnityTypes.IsObject(type) ? "object"
                : UnityTypes.IsEngine(type) ? "struct" : "class";
            long[]? values = isEnum && !UnityTypes.Has(type, "Flags") ? type.GetMembers().OfType<IFieldSymbol>()
                .Select(item => Convert.ToInt64(item.ConstantValue, System.Globalization.CultureInfo.InvariantCulture))
                .ToArray() : null;
            string[] fields = kind == "class" && type is INamedTypeSymbol named
                ? FieldRules.Stored(named).Select(inner => inner.Name).ToArray() : Array.Empty<string>();
            string[] former = field.GetAttributes()
                .Where(attribute => UnityTypes.Name(attribute) == "FormerlySerializedAs")
                .SelectMany(attribute => attribute.ConstructorArguments).Select(argument => argument.Value as string)
                .OfType<string>().ToArray();
            string typeName = type.ToDisplayString(Short);
            return new StoredField(kind, typeName, !SymbolEqualityComparer.Default.Equals(type, field.Type),
                IsNeeded(field), former, FieldRules.Limits(field), values, fields);
        }

        /// <summary>Whether a field starts as <c>null!</c>.</summary>
        private static bool IsNeeded(IFieldSymbol field)
        {
            return field.DeclaringSyntaxReferences.FirstOrDefault()?.GetSyntax() is VariableDeclaratorSyntax declared
                && declared.Initializer?.Value.ToString() == "null!";
        }
    }
}
