using Guidewire.Runtime;
using UnityEditor;
using UnityEngine;

namespace Guidewire.Editor
{
    /// <summary>Entries of Unity's menus that make things: a wire in a vessel, and files for parameters and
    /// instruments.</summary>
    internal static class CreateMenu
    {
        private const string Prefab = "Assets/Guidewire/Prefabs/WireInVessel.prefab";

        private const string Parameters = "{\n  \"formatVersion\": 2,\n  \"solver\": \"direct\",\n"
            + "  \"guidewireLength\": 120.0,\n  \"numberRodElements\": 24,\n  \"guidewireOffset\": -130.0,\n"
            + "  \"wireRadius\": 0.00045,\n  \"massDamping\": 20.0,\n  \"proximalEnd\": \"clamped\",\n"
            + "  \"timeStep\": 0.01,\n  \"deltaThreshold\": 0.0,\n  \"maxSimulationSteps\": 1000000000\n}\n";

        private const string Instrument = "{\n  \"title\": \"My wire, 0.035 in\",\n  \"kind\": \"guidewire\",\n"
            + "  \"diameter\": {\"value\": \"0.035 in\", \"basis\": \"assumed\", \"source\": \"say where from\"},\n"
            + "  \"length\": {\"value\": \"150 cm\", \"basis\": \"assumed\", \"source\": \"say where from\"},\n"
            + "  \"bendingStiffness\": {\"value\": \"2e-4 N m2\", \"basis\": \"assumed\", "
            + "\"source\": \"say where from\"},\n"
            + "  \"torsionalRatio\": {\"value\": \"0.77\", \"basis\": \"assumed\", \"source\": \"say where from\"},\n"
            + "  \"density\": {\"value\": \"7900 kg/m3\", \"basis\": \"assumed\", \"source\": \"say where from\"},\n"
            + "  \"friction\": {\"value\": \"0.1\", \"basis\": \"assumed\", \"source\": \"say where from\"},\n"
            + "  \"tip\": {\"shape\": \"straight\", \"basis\": \"assumed\", \"source\": \"say where from\"}\n}\n";

        private static readonly Vector3 Middle = new Vector3(0f, 30f, 0f);    // of the prefab's vessel, units
        private const float Distance = 400f;

        // An instance of the prefab, below what is selected, in the picture of the scene view and of the camera.
        [MenuItem("GameObject/Guidewire/Wire in a vessel", false, 10)]
        private static void CreateWire(MenuCommand command)
        {
            string path = PathOf(Prefab);
            var made = (GameObject)PrefabUtility.InstantiatePrefab(AssetDatabase.LoadAssetAtPath<GameObject>(path));
            GameObjectUtility.SetParentAndAlign(made, command.context as GameObject);
            Undo.RegisterCreatedObjectUndo(made, "Create wire in a vessel");
            Selection.activeObject = made;
            Show(made.GetComponent<SimulationLoop>());
        }

        // A camera that a script of the user's moves is left alone.
        private static void Show(SimulationLoop loop)
        {
            Transform frame = loop.transform;
            if (SceneView.lastActiveSceneView)
            {
                Vector3 size = 2f * (frame.TransformPoint(Middle + 130f * Vector3.forward)
                    - frame.TransformPoint(Middle)).magnitude * Vector3.one;
                SceneView.lastActiveSceneView.Frame(new Bounds(frame.TransformPoint(Middle), size), true);
            }
            Camera? camera = Camera.main;
            if (!camera)
            {
                var made = new GameObject("Wire camera") { tag = "MainCamera" };
                camera = made.AddComponent<Camera>();
                Undo.RegisterCreatedObjectUndo(made, "Create wire in a vessel");
            }
            else if (System.Array.Exists(camera!.GetComponents<MonoBehaviour>(), IsOfAUser))
            {
                return;
            }
            Undo.RecordObject(camera!.transform, "Create wire in a vessel");
            Undo.RecordObject(camera, "Create wire in a vessel");
            OrbitCamera orbit = Undo.AddComponent<OrbitCamera>(camera.gameObject);
            (orbit.Loop, orbit.Target, orbit.Distance) = (loop, Middle, Distance);
            orbit.Look();
        }

        private static bool IsOfAUser(MonoBehaviour script) =>
            !(script.GetType().Namespace ?? "").StartsWith("UnityEngine", System.StringComparison.Ordinal);

        [MenuItem("Assets/Create/Guidewire/Parameters")]
        private static void CreateParameters() =>
            TextFile.Create("Parameters.json", Parameters);

        [MenuItem("Assets/Create/Guidewire/Instrument")]
        private static void CreateInstrument() =>
            TextFile.Create("Instrument.json", Instrument);

        // In this repository's project below Assets, in others' below Packages.
        private static string PathOf(string path)
        {
            UnityEditor.PackageManager.PackageInfo? package =
                UnityEditor.PackageManager.PackageInfo.FindForAssembly(typeof(CreateMenu).Assembly);
            return package == null ? path : package.assetPath + path.Substring("Assets/Guidewire".Length);
        }
    }
}
