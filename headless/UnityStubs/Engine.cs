using System;
using System.Collections.Generic;
using System.Reflection;
using UnityEngine;

namespace UnityStubs
{
    /// <summary>Calls a MonoBehaviour's messages in the order in which Unity does: Awake of all, then each frame Start
    /// of the new ones, Update, LateUpdate, and OnGUI twice (layout, repaint).</summary>
    public static class Engine
    {
        private sealed class Live
        {
            public MonoBehaviour Behaviour;
            public Action Start;
            public Action Update;
            public Action LateUpdate;
            public Action OnGUI;
            public Action OnDestroy;
            public Action OnEnable;
            public Action OnDisable;
            public Action FixedUpdate;
            public int Order;
            public bool IsAwake;
            public bool IsEnabled;
            public bool IsStarted;
        }

        internal static readonly List<MeshRenderer> Renderers = new List<MeshRenderer>();
        private static System.Threading.Thread _main;

        private static readonly List<Live> Behaviours = new List<Live>();
        private static readonly List<GameObject> Objects = new List<GameObject>();

        private static float _fixedTime;

        /// <summary>Every line that was logged.</summary>
        public static List<(LogType Type, string Text)> Console { get; } = new List<(LogType, string)>();

        /// <summary>Texts of labels in the last frame.</summary>
        public static List<string> Labels { get; } = new List<string>();

        /// <summary>Where marks were drawn in the last frame, and in which material.</summary>
        public static List<(Mesh Mesh, Matrix4x4 Place, Material Material, int Layer)> Drawn { get; } =
            new List<(Mesh, Matrix4x4, Material, int)>();

        /// <summary>What the process was ended with, or null.</summary>
        public static int? ExitCode { get; set; }

        /// <summary>The start of a button's text that is clicked in the next frame.</summary>
        public static string Click { get; set; }

        /// <summary>A process that has just started.</summary>
        /// <param name="projectRoot">Folder that holds Assets.</param>
        public static void Reset(string projectRoot)
        {
            _main = System.Threading.Thread.CurrentThread;
            Unload();
            Console.Clear();
            Input.Held.Clear();
            Input.Down.Clear();
            Input.Buttons.Clear();
            Input.IsRefused = false;
            ExitCode = null;
            Click = null;
            Screen.dpi = 96f;
            UnityEngine.Rendering.GraphicsSettings.currentRenderPipeline = null;
            UnityEngine.InputSystem.Keyboard.current = null;
            UnityEngine.InputSystem.Mouse.current = null;
            Application.platform = RuntimePlatform.LinuxEditor;
            Application.dataPath = System.IO.Path.Combine(projectRoot, "Assets");
            Application.isBatchMode = false;
            Application.isEditor = true;
            Application.isPlaying = true;
        }

        /// <summary>Takes objects whose components have their fields, and wakes them.</summary>
        public static void Enter(IEnumerable<GameObject> objects)
        {
            var entered = new List<GameObject>(objects);
            Objects.AddRange(entered);
            foreach (GameObject gameObject in entered)
            {
                foreach (Component component in gameObject.components.ToArray())
                {
                    Awaken(component);
                }
            }
        }

        /// <summary>The component of a type in the scene, or null.</summary>
        public static T Find<T>()
            where T : Component
        {
            foreach (GameObject gameObject in Objects)
            {
                T found = gameObject.GetComponent<T>();
                if (!(found is null))
                {
                    return found;
                }
            }
            return null;
        }

        internal static T[] FindAll<T>()
            where T : Component => Objects.ConvertAll(one => one.GetComponent<T>()).FindAll(one => one != null)
            .ToArray();

        /// <summary>What Unity's objects do on any other thread than its own.</summary>
        internal static void RequireMainThread()
        {
            if (_main != null && _main != System.Threading.Thread.CurrentThread)
            {
                throw new UnityException("can only be called from the main thread");
            }
        }

        internal static T OnMainThread<T>(T value)
        {
            RequireMainThread();
            return value;
        }

        /// <summary>One frame.</summary>
        /// <param name="seconds">Real time since the last one.</param>
        public static void Frame(float seconds)
        {
            Time.deltaTime = seconds;
            Drawn.Clear();
            for (int i = 0; i < Behaviours.Count; i++)
            {
                Live live = Behaviours[i];
                if (live.IsEnabled && !live.IsStarted)
                {
                    live.IsStarted = true;
                    live.Start?.Invoke();
                }
            }
            _fixedTime += seconds;
            while (_fixedTime >= Time.fixedDeltaTime)
            {
                _fixedTime -= Time.fixedDeltaTime;
                for (int i = 0; i < Behaviours.Count; i++)
                {
                    Run(Behaviours[i], Behaviours[i].FixedUpdate);
                }
            }
            for (int i = 0; i < Behaviours.Count; i++)
            {
                Run(Behaviours[i], Behaviours[i].Update);
            }
            for (int i = 0; i < Behaviours.Count; i++)
            {
                Run(Behaviours[i], Behaviours[i].LateUpdate);
            }
            int place = 0;
            foreach (MeshRenderer renderer in Renderers)    // before what is drawn for the frame alone
            {
                Mesh mesh = renderer.gameObject.GetComponent<MeshFilter>()?.sharedMesh;
                if (!renderer.isDestroyed && renderer.enabled && renderer.gameObject.activeInHierarchy && mesh != null
                    && renderer.sharedMaterial != null)
                {
                    Drawn.Insert(place++, (mesh, renderer.transform.localToWorldMatrix, renderer.sharedMaterial,
                        renderer.gameObject.layer));
                }
            }
            for (int pass = 0; pass < 2; pass++)
            {
                Labels.Clear();
                for (int i = 0; i < Behaviours.Count; i++)
                {
                    Run(Behaviours[i], Behaviours[i].OnGUI);
                }
            }
            Input.Down.Clear();
            Input.mouseScrollDelta = default;
        }

        /// <summary>A key goes down, and stays down until <see cref="Release"/>.</summary>
        public static void Press(KeyCode key)
        {
            Input.Held.Add(key);
            Input.Down.Add(key);
        }

        /// <summary>A key goes up.</summary>
        public static void Release(KeyCode key) => Input.Held.Remove(key);

        /// <summary>The mouse is somewhere, with a button down or none, and its wheel turned.</summary>
        public static void Mouse(float x, float y, int button, float wheel)
        {
            Input.Buttons.Clear();
            if (button >= 0)
            {
                Input.Buttons.Add(button);
            }
            Input.mousePosition = new Vector3(x, y, 0f);
            Input.mouseScrollDelta = new Vector2(0f, wheel);
        }

        /// <summary>Leaves input to the Input System package: every call of Input throws from here on.</summary>
        public static void RefuseInput() => Input.IsRefused = true;

        /// <summary>What Unity does where scripts are compiled anew in Play: what is not kept is as in a new object.
        /// </summary>
        public static void Reload(Func<FieldInfo, bool> isKept)
        {
            UnityEditor.AssemblyReloadEvents.Raise();
            foreach (Live live in Behaviours)
            {
                (live.IsEnabled ? live.OnDisable : null)?.Invoke();
                object made = Activator.CreateInstance(live.Behaviour.GetType());
                for (Type type = live.Behaviour.GetType(); type != typeof(MonoBehaviour); type = type.BaseType)
                {
                    foreach (FieldInfo field in type.GetFields(BindingFlags.DeclaredOnly | BindingFlags.Instance
                        | BindingFlags.Public | BindingFlags.NonPublic))
                    {
                        if (!isKept(field))
                        {
                            field.SetValue(live.Behaviour, field.GetValue(made));
                        }
                    }
                }
            }
            foreach (Live live in Behaviours)
            {
                (live.IsEnabled ? live.OnEnable : null)?.Invoke();
            }
        }

        /// <summary>Methods that a player calls as it starts, in Unity's order.</summary>
        public static IEnumerable<MethodInfo> Initializers(Assembly assembly)
        {
            var found = new List<MethodInfo>();
            foreach (Type type in assembly.GetTypes())
            {
                found.AddRange(Array.FindAll(type.GetMethods(BindingFlags.Static | BindingFlags.Public
                    | BindingFlags.NonPublic), one => one.IsDefined(typeof(RuntimeInitializeOnLoadMethodAttribute))));
            }
            return found;
        }

        /// <summary>Play is pressed: what runs in Edit Mode is switched off there, then all objects wake.</summary>
        public static void EnterPlay(params GameObject[] objects)
        {
            foreach (GameObject one in objects)
            {
                foreach (Component component in one.components.ToArray())
                {
                    if (component is MonoBehaviour own && own.GetType().IsDefined(typeof(ExecuteAlways)))
                    {
                        Message(own, "OnDisable")?.Invoke();
                    }
                }
            }
            Application.isPlaying = true;
            Enter(objects);
        }

        /// <summary>Destroys every object.</summary>
        public static void Unload()
        {
            foreach (GameObject gameObject in Objects.ToArray())
            {
                UnityEngine.Object.DestroyImmediate(gameObject);
            }
            Objects.Clear();
            Behaviours.Clear();
            Renderers.Clear();
            Camera.All.Clear();
        }

        internal static void Awaken(Component component)
        {
            if (!Application.isPlaying || !(component is MonoBehaviour behaviour))
            {
                return;
            }
            int order = behaviour.GetType().GetCustomAttribute<DefaultExecutionOrder>()?.order ?? 0;
            int place = Behaviours.FindIndex(other => other.Order > order);
            var live = new Live
            {
                Behaviour = behaviour,
                Order = order,
                Start = Message(behaviour, "Start"),
                Update = Message(behaviour, "Update"),
                LateUpdate = Message(behaviour, "LateUpdate"),
                OnGUI = Message(behaviour, "OnGUI"),
                OnDestroy = Message(behaviour, "OnDestroy"),
                OnEnable = Message(behaviour, "OnEnable"),
                OnDisable = Message(behaviour, "OnDisable"),
                FixedUpdate = Message(behaviour, "FixedUpdate"),
            };
            Behaviours.Insert(place < 0 ? Behaviours.Count : place, live);
            if (!Objects.Contains(behaviour.gameObject))
            {
                Objects.Add(behaviour.gameObject);
            }
            Update(live);
        }

        /// <summary>Sends what follows from objects and components that were switched on or off.</summary>
        internal static void UpdateEnabled()
        {
            foreach (Live live in Behaviours.ToArray())
            {
                Update(live);
            }
        }

        // Awake once its object is active, then OnEnable and OnDisable as they come.
        private static void Update(Live live)
        {
            if (!live.IsAwake && live.Behaviour.gameObject.activeInHierarchy)
            {
                live.IsAwake = true;
                Message(live.Behaviour, "Awake")?.Invoke();
            }
            bool isEnabled = live.IsAwake && live.Behaviour.isActiveAndEnabled;
            if (isEnabled != live.IsEnabled)
            {
                live.IsEnabled = isEnabled;
                (isEnabled ? live.OnEnable : live.OnDisable)?.Invoke();
            }
        }

        internal static void Remove(Component component)
        {
            Live live = Behaviours.Find(item => ReferenceEquals(item.Behaviour, component));
            if (live != null)
            {
                Behaviours.Remove(live);
                if (live.IsEnabled)
                {
                    live.OnDisable?.Invoke();
                }
                if (live.IsAwake)
                {
                    live.OnDestroy?.Invoke();
                }
            }
        }

        internal static void Draw(Mesh mesh, Matrix4x4 place, Material material, int layer) =>
            Drawn.Add((mesh, place, material, layer));

        internal static void Show(string text) => Labels.Add(text);

        internal static bool IsClicked(string text)
        {
            bool clicked = Click != null && text.StartsWith(Click, StringComparison.Ordinal);
            Click = clicked ? null : Click;
            return clicked;
        }

        internal static void Write(LogType type, object message)
        {
            string text = message?.ToString() ?? "";
            Console.Add((type, text));
            UnityEngine.TestTools.LogAssert.Take(type, text);
        }

        private static void Run(Live live, Action message)
        {
            if (message != null && live.IsEnabled && live.IsStarted)
            {
                message();
            }
        }

        private static Action Message(MonoBehaviour behaviour, string name)
        {
            MethodInfo method = behaviour.GetType().GetMethod(name,
                BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic, null, Type.EmptyTypes, null);
            return method == null ? null : (Action)Delegate.CreateDelegate(typeof(Action), behaviour, method);
        }
    }
}
