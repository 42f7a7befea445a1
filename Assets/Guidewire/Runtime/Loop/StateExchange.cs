using System.Threading;

namespace Guidewire.Runtime
{
    /// <summary>Hands states from the thread that steps to the one that shows: neither ever waits. Each has a state of
    /// its own, a third lies between them.</summary>
    internal sealed class StateExchange
    {
        private WireState _between;

        /// <summary>Makes the exchange with the state that lies between them at first.</summary>
        public StateExchange(WireState between)
        {
            _between = between;
        }

        /// <summary>Leaves a state for the other thread, in place of one that it may not have taken.</summary>
        /// <param name="mine">Written; then another one to write into.</param>
        public void Publish(ref WireState mine)
        {
            mine.IsNew = true;
            mine = Interlocked.Exchange(ref _between, mine);
        }

        /// <summary>Takes the newest state.</summary>
        /// <param name="mine">The oldest that is no longer needed; then the newest.</param>
        /// <returns>False where there is none since the last.</returns>
        public bool TakeNewest(ref WireState mine)
        {
            if (!Volatile.Read(ref _between).IsNew)
            {
                return false;
            }
            mine.IsNew = false;
            mine = Interlocked.Exchange(ref _between, mine);
            return true;
        }
    }
}
