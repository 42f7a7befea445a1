namespace Guidewire.UnityCheck.Rules
{
    /// <summary>Unity's messages: methods that nobody would miss before the scene stands still.</summary>
    internal static class MessageRules
    {
        private static readonly Dictionary<string, string[]> Messages = Table();

        /// <summary>Messages that may be coroutines; the others Unity refuses when it sends them.</summary>
        private static readonly string[] Coroutines =
        {
            "Start", "OnCollision", "OnTrigger", "OnMouse", "OnBecame", "OnApplicationPause", "OnApplicationFocus",
        };

        private static readonly string[] Tasks = { "Task", "Awaitable", "UniTask", "UniTaskVoid", "ValueTask" };

        public static void Check(Source source)
        {
            foreach (INamedTypeSymbol type in source.Types.Where(UnityTypes.IsBehaviour))
            {
                foreach (IMethodSymbol method in source.Members<IMethodSymbol>(type)
                    .Where(method => method.MethodKind == MethodKind.Ordinary))
                {
                    CheckMessage(source, method);
                }
            }
        }

        /// <summary>Each message with the parameters that it may have, their types separated by commas.</summary>
        private static Dictionary<string, string[]> Table()
        {
            var table = new Dictionary<string, string[]>();
            Add(table, "Awake Start Update FixedUpdate LateUpdate OnEnable OnDisable OnDestroy OnGUI OnValidate Reset "
                + "OnDrawGizmos OnDrawGizmosSelected OnApplicationQuit OnRenderObject OnPreRender OnPostRender "
                + "OnPreCull OnWillRenderObject OnBecameVisible OnBecameInvisible OnMouseDown OnMouseUp OnMouseDrag "
                + "OnMouseEnter "
                + "OnMouseExit OnMouseOver OnMouseUpAsButton OnTransformChildrenChanged OnTransformParentChanged "
                + "OnBeforeTransformParentChanged OnAnimatorMove OnParticleTrigger OnParticleSystemStopped "
                + "OnParticleUpdateJobScheduled OnCanvasGroupChanged OnCanvasHierarchyChanged "
                + "OnRectTransformDimensionsChange OnDidApplyAnimationProperties OnConnectedToServer "
                + "OnServerInitialized", "");
            Add(table, "OnCollisionEnter OnCollisionStay OnCollisionExit", "", "Collision");
            Add(table, "OnCollisionEnter2D OnCollisionStay2D OnCollisionExit2D", "", "Collision2D");
            Add(table, "OnTriggerEnter OnTriggerStay OnTriggerExit", "", "Collider");
            Add(table, "OnTriggerEnter2D OnTriggerStay2D OnTriggerExit2D", "", "Collider2D");
            Add(table, "OnApplicationPause OnApplicationFocus", "", "bool");
            Add(table, "OnJointBreak", "", "float");
            Add(table, "OnJointBreak2D", "", "Joint2D");
            Add(table, "OnParticleCollision", "", "GameObject");
            Add(table, "OnAnimatorIK", "", "int");
            Add(table, "OnControllerColliderHit", "", "ControllerColliderHit");
            Add(table, "OnRenderImage", "RenderTexture,RenderTexture");
            Add(table, "OnAudioFilterRead", "float[],int");
            return table;
        }

        private static void Add(Dictionary<string, string[]> table, string names, params string[] parameters)
        {
            foreach (string name in names.Split(' '))
            {
                table[name] = parameters;
            }
        }

        private static bool IsCoroutine(IMethodSymbol method)
        {
            return method.ReturnType.Name == "IEnumerator";
        }

        /// <summary>Whether a method may be called from another source.</summary>
        private static bool IsReachable(IMethodSymbol method)
        {
            return method.DeclaredAccessibility != Accessibility.Private || method.IsStatic;
        }

        private static bool IsNamed(Source source, IMethodSymbol method)
        {
            return source.Usage.IsNamed(source.Tree, method.Name, IsReachable(method));
        }

        private static void CheckMessage(Source source, IMethodSymbol method)
        {
            string name = method.Name;
            if (Messages.TryGetValue(name, out string[]? allowed))
            {
                string parameters = string.Join(",", method.Parameters.Select(parameter =>
                    parameter.Type.ToDisplayString(SymbolDisplayFormat.MinimallyQualifiedFormat)));
                bool mayWait = IsCoroutine(method) && Coroutines.Any(
                    start => name.StartsWith(start, StringComparison.Ordinal));
                string? reason = method.IsStatic || method.IsGenericMethod
                        ? "must be an instance method without type parameters"
                    : !method.ReturnsVoid && !mayWait && !Tasks.Contains(method.ReturnType.Name)
                        ? "returns " + method.ReturnType.Name + "; Unity's message is void"
                    : !allowed.Contains(parameters) && !method.IsOverride
                        ? "(" + parameters + ") is never sent; its parameters are (" + string.Join(") or (", allowed)
                        + ")"
                    : null;
                if (reason != null)
                {
                    source.Report(method, "script-message", name + " " + reason);
                }
                return;
            }
            if (!method.GetAttributes().IsEmpty || method.IsOverride || (!method.ReturnsVoid && !IsCoroutine(method)))
            {
                return;
            }
            string? right = Messages.Keys.FirstOrDefault(
                message => message.Equals(name, StringComparison.OrdinalIgnoreCase));
            if (right == null && method.ReturnsVoid && !IsNamed(source, method))
            {
                right = Messages.Keys.FirstOrDefault(message => IsNear(message, name));
                if (right == null && !IsReachable(method))
                {
                    source.Report(method, "script-message", name + " is no message of Unity's and nobody calls it");
                }
            }
            if (right != null)
            {
                source.Report(method, "script-message", name + ": Unity's message is called " + right);
            }
        }

        /// <summary>Whether one letter added, lost, changed or exchanged with its neighbour makes one word the other.
        /// </summary>
        private static bool IsNear(string a, string b)
        {
            (a, b) = a.Length > b.Length ? (b, a) : (a, b);
            if (a == b || b.Length - a.Length > 1)
            {
                return false;
            }
            int i = 0;
            while (i < a.Length && a[i] == b[i])
            {
                i++;
            }
            if (a.Length < b.Length)
            {
                return a.Substring(i) == b.Substring(i + 1);
            }
            return a.Substring(i + 1) == b.Substring(i + 1) || (i + 1 < a.Length && a[i] == b[i + 1] && a[i + 1] == b[i]
                && a.Substring(i + 2) == b.Substring(i + 2));
        }
    }
}
