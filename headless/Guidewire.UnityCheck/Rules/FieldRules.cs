using System.Globalization;

namespace Guidewire.UnityCheck.Rules
{
    /// <summary>Fields that Unity stores, those that it leaves out without a word though an attribute asks for them,
    /// and initialisers that ask the engine too early.</summary>
    internal static class FieldRules
    {
        private static readonly HashSet<string> Inspector = new HashSet<string>
        {
            "SerializeField", "Range", "Tooltip", "Header", "Min", "TextArea", "Multiline", "ColorUsage", "Delayed",
            "GradientUsage", "ContextMenuItem", "FormerlySerializedAs", "InspectorName", "Space",
        };

        private static readonly string[] Vectors = { "Vector2", "Vector3", "Vector4", "Vector2Int", "Vector3Int" };

        /// <summary>Statics of the engine that a constructor may not ask: they throw, or give the editor's values.
        /// </summary>
        private static readonly HashSet<string> Statics = new HashSet<string>
        {
            "Time", "Application", "Screen", "Input", "Camera", "Resources", "GameObject", "Random", "SystemInfo",
            "Physics", "PlayerPrefs", "QualitySettings", "SceneManager", "Shader", "Graphics", "RenderSettings",
            "Cursor",
            "GUI", "GUILayout", "GUIUtility", "AssetDatabase", "EditorPrefs", "EditorApplication", "Display",
            "ScriptableObject",
        };

        private static readonly HashSet<string> Searches = new HashSet<string>
        {
            "FindObjectOfType", "FindObjectsOfType", "FindFirstObjectByType", "FindAnyObjectByType",
            "FindObjectsByType",
            "Instantiate", "GetComponent", "GetComponentInChildren", "GetComponentInParent", "AddComponent",
            "CreateInstance",
        };

        private static readonly HashSet<string> Native = new HashSet<string>
        {
            "GameObject", "Material", "Mesh", "Texture2D", "Texture3D", "RenderTexture", "MaterialPropertyBlock",
            "ComputeBuffer", "GraphicsBuffer", "Cubemap",
        };

        public static void Check(Source source)
        {
            foreach (INamedTypeSymbol type in source.Types)
            {
                bool isAttached = UnityTypes.IsMadeByUnity(type);
                bool holds = isAttached || type.IsSerializable;
                foreach (ISymbol member in source.Members<ISymbol>(type))
                {
                    if (member is IFieldSymbol || member is IPropertySymbol)
                    {
                        CheckMember(source, type, member, holds);
                    }
                }
                if (isAttached)
                {
                    CheckShadowedField(source, type);
                }
            }
        }

        /// <summary>The fields that a scene may hold for a type, those of its bases included.</summary>
        public static IEnumerable<IFieldSymbol> Stored(INamedTypeSymbol type)
        {
            return UnityTypes.Chain(type).Where(above => above.Locations.Any(place => place.IsInSource))
                .SelectMany(above => above.GetMembers().OfType<IFieldSymbol>())
                .Where(field => IsStored(field) && Refusal(field) == null)
                .GroupBy(field => field.Name).Select(same => same.First());
        }

        /// <summary>The type that an array or list holds, or the type itself.</summary>
        public static ITypeSymbol Element(ITypeSymbol type)
        {
            return type is IArrayTypeSymbol array ? array.ElementType : IsList(type)
                ? ((INamedTypeSymbol)type).TypeArguments[0]
                : type;
        }

        public static bool IsNumber(ITypeSymbol type)
        {
            return type.SpecialType >= SpecialType.System_SByte && type.SpecialType <= SpecialType.System_Double
                && type.SpecialType != SpecialType.System_Decimal;
        }

        /// <summary>The limits of [Range]; empty where there is none.</summary>
        public static double[] Limits(IFieldSymbol field)
        {
            AttributeData? range = field.GetAttributes()
                .FirstOrDefault(attribute => UnityTypes.Name(attribute) == "Range");
            return range == null ? Array.Empty<double>()
                : range.ConstructorArguments.Where(argument => argument.Value != null)
                // By its digits: 0.01f is 0.01 in a file, not the double next to it.
                .Select(argument => Convert.ToDouble(Convert.ToDecimal(argument.Value, CultureInfo.InvariantCulture),
                    CultureInfo.InvariantCulture)).ToArray();
        }

        /// <summary>Whether Unity stores a field, its type left aside. A property's field has the attributes that are
        /// meant for it.</summary>
        private static bool IsStored(IFieldSymbol field)
        {
            bool asked = UnityTypes.Has(field, "SerializeField") || UnityTypes.Has(field, "SerializeReference");
            bool isOpen = field.DeclaredAccessibility == Accessibility.Public
                && !UnityTypes.Has(field, "NonSerialized");
            return (asked || isOpen) && !field.IsStatic && !field.IsConst && !field.IsReadOnly
                && !(field.AssociatedSymbol is IEventSymbol);
        }

        /// <summary>Why Unity does not store a field of this type; null where it does, or where the type is not known.
        /// </summary>
        private static string? Refusal(IFieldSymbol field)
        {
            if (UnityTypes.Has(field, "SerializeReference"))
            {
                return null;
            }
            ITypeSymbol type = Element(field.Type);
            string name = field.Type.ToDisplayString(SymbolDisplayFormat.MinimallyQualifiedFormat);
            if (type is IArrayTypeSymbol || IsList(type) || field.Type is IArrayTypeSymbol { Rank: > 1 })
            {
                return name + ": arrays and lists of one dimension only";
            }
            if (type.OriginalDefinition.SpecialType == SpecialType.System_Nullable_T)
            {
                return name + ": no value that may be missing";
            }
            if (IsNumber(type) || type.SpecialType == SpecialType.System_Boolean || type.TypeKind == TypeKind.Error
                || type.SpecialType == SpecialType.System_String || type.SpecialType == SpecialType.System_Char
                || UnityTypes.IsEngine(type) || UnityTypes.IsObject(type) || type.TypeKind == TypeKind.TypeParameter)
            {
                return null;
            }
            if (type is INamedTypeSymbol { TypeKind: TypeKind.Enum, EnumUnderlyingType: { } number })
            {
                return number.SpecialType == SpecialType.System_Int64 || number.SpecialType == SpecialType.System_UInt64
                    ? name + " has 64 bits" : null;
            }
            return type.TypeKind == TypeKind.Interface ? name + " is an interface (SerializeReference stores one)"
                : type.Locations.All(place => !place.IsInSource) || type.IsTupleType
                    || type.TypeKind == TypeKind.Delegate
                    ? name + " is no type that it stores"
                : !((INamedTypeSymbol)type).IsSerializable ? name + " is not [Serializable]"
                : type.TypeKind == TypeKind.Class && type.IsAbstract
                    ? name + " is abstract (SerializeReference stores one)"
                : null;
        }

        private static bool IsList(ITypeSymbol type)
        {
            return type.OriginalDefinition.ToDisplayString() == "System.Collections.Generic.List<T>";
        }

        private static void CheckMember(Source source, INamedTypeSymbol type, ISymbol member, bool holds)
        {
            var field = member as IFieldSymbol;
            if (field == null || !field.IsImplicitlyDeclared)
            {
                if (holds)
                {
                    CheckInitialiser(source, member);
                }
            }
            AttributeData[] asking = member.GetAttributes().Where(IsAsking).ToArray();
            if (asking.Length == 0)
            {
                return;
            }
            var home = field?.AssociatedSymbol ?? member;
            bool asked = UnityTypes.Has(member, "SerializeField");
            string name = type.Name + "." + home.Name;
            string? reason = asked && !holds ? type.Name + " is neither a behaviour nor [Serializable]"
                : field == null ? "a property is not stored; its field is with [field: SerializeField]"
                : field.IsConst || field.IsStatic || field.IsReadOnly
                    ? "constant, static and readonly fields are not stored"
                : UnityTypes.Has(field, "NonSerialized") ? "it is [NonSerialized] as well"
                : !IsStored(field) ? "[" + UnityTypes.Name(asking[0])
                    + "] on a field that is neither public nor [SerializeField]"
                : Refusal(field);
            if (reason != null && (asked || holds))
            {
                source.Report(home, "field-stored", name + " is left out by Unity without a word: " + reason);
            }
            else if (field != null)
            {
                CheckDrawing(source, name, home, field, asking);
            }
        }

        private static bool IsAsking(AttributeData attribute)
        {
            return Inspector.Contains(UnityTypes.Name(attribute))
                || UnityTypes.Chain(attribute.AttributeClass).Any(above => above.Name == "PropertyAttribute");
        }

        private static void CheckDrawing(Source source, string name, ISymbol home, IFieldSymbol field,
            AttributeData[] asking)
        {
            ITypeSymbol type = Element(field.Type);
            foreach (AttributeData attribute in asking)
            {
                bool isDrawn = UnityTypes.Name(attribute) switch
                {
                    "Range" => IsNumber(type),
                    "Min" => IsNumber(type) || Vectors.Contains(type.Name),
                    "TextArea" => type.SpecialType == SpecialType.System_String,
                    "Multiline" => type.SpecialType == SpecialType.System_String,
                    "ColorUsage" => type.Name == "Color",
                    "GradientUsage" => type.Name == "Gradient",
                    "Delayed" => IsNumber(type) || type.SpecialType == SpecialType.System_String,
                    _ => true,
                };
                if (!isDrawn && type.TypeKind != TypeKind.Error)
                {
                    source.Report(home, "field-attribute",
                        name + ": [" + UnityTypes.Name(attribute) + "] cannot draw a " + type.Name);
                }
            }
            double[] limits = Limits(field);
            if (limits.Length == 2 && !(limits[0] < limits[1]))
            {
                source.Report(home, "field-attribute", name + ": [Range] from " + limits[0] + " to " + limits[1]);
            }
        }

        private static void CheckInitialiser(Source source, ISymbol member)
        {
            SyntaxNode? declared = member.DeclaringSyntaxReferences.FirstOrDefault()?.GetSyntax();
            ExpressionSyntax? value = declared switch
            {
                VariableDeclaratorSyntax field => field.Initializer?.Value,
                PropertyDeclarationSyntax property => property.Initializer?.Value,
                _ => null,
            };
            if (value == null)
            {
                return;
            }
            // What runs later, in a lambda, may ask anything; names in nameof and typeof are not asked at all.
            foreach (SyntaxNode node in value.DescendantNodesAndSelf(IsRequestedNow))
            {
                string? early = node switch
                {
                    ObjectCreationExpressionSyntax made when Native.Contains(LastName(made.Type)) =>
                        "new " + LastName(made.Type) + " belongs into Awake",
                    MemberAccessExpressionSyntax access when IsEngineStatic(access.Expression) =>
                        access + " may not be asked before Awake",
                    InvocationExpressionSyntax call when Searches.Contains(CallTable.CalledName(call)) =>
                        CallTable.CalledName(call) + " may not be asked before Awake",
                    _ => null,
                };
                if (early != null)
                {
                    source.Report(node, "field-initialiser", member.Name + ": " + early);
                }
            }
        }

        private static bool IsRequestedNow(SyntaxNode node)
        {
            return !(node is AnonymousFunctionExpressionSyntax || node is TypeOfExpressionSyntax
                || (node is InvocationExpressionSyntax call && CallTable.CalledName(call) == "nameof"));
        }

        private static bool IsEngineStatic(ExpressionSyntax owner)
        {
            return owner is IdentifierNameSyntax name ? Statics.Contains(name.Identifier.ValueText)
                : owner is MemberAccessExpressionSyntax access && Statics.Contains(access.Name.Identifier.ValueText)
                    && (access.Expression.ToString() == "UnityEngine" || access.Expression.ToString() == "UnityEditor");
        }

        private static string LastName(TypeSyntax type)
        {
            return type.ToString().Split('.').Last();
        }

        private static void CheckShadowedField(Source source, INamedTypeSymbol type)
        {
            foreach (IFieldSymbol field in source.Members<IFieldSymbol>(type).Where(IsStored))
            {
                if (UnityTypes.Chain(type.BaseType).SelectMany(above => above.GetMembers(field.Name))
                    .OfType<IFieldSymbol>()
                    .Any(IsStored))
                {
                    source.Report(field, "field-stored", type.Name + "." + field.Name
                        + " is stored by a base class, too; Unity refuses both");
                }
            }
        }
    }
}
