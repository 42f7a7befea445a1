using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Shows something of a loop's run, in the frame of the loop's object. Without a loop of its own it takes
    /// the one of its object, or of the nearest object above.</summary>
    public abstract class LoopView : MonoBehaviour
    {
        [Tooltip("What is shown; empty: the loop of this object, or of the nearest above.")]
        [SerializeField] private SimulationLoop? _loop;

        [System.NonSerialized] private SimulationLoop? _found;
        [System.NonSerialized] private SimulationLoop? _builtLoop;    // what was built is not kept by a reload either
        [System.NonSerialized] private int _builtGeneration;

        /// <summary>What is shown; null where there is none.</summary>
        public SimulationLoop? Loop
        {
            get
            {
                if (_loop)
                {
                    return _loop;
                }
                if (!_found || !Application.isPlaying)    // in Edit Mode it may come below another one
                {
                    _found = GetComponentInParent<SimulationLoop>();
                }
                return _found ? _found : null;
            }
            set => _loop = value;
        }

        /// <summary>Maps units of the wire to the world.</summary>
        protected Matrix4x4 Place => Loop!.transform.localToWorldMatrix;

        /// <summary>Whether the loop has another run than when this was last asked.</summary>
        protected bool IsNewRun()
        {
            SimulationLoop? loop = Loop;
            bool isNew = loop != _builtLoop || (loop != null && loop.Generation != _builtGeneration);
            _builtLoop = loop;
            _builtGeneration = loop == null ? 0 : loop.Generation;
            return isNew;
        }
    }
}
