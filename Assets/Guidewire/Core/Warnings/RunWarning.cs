namespace Guidewire.Core
{
    /// <summary>A warning of one run.</summary>
    internal readonly struct RunWarning
    {
        /// <param name="text">Its line.</param>
        public RunWarning(WarningKind kind, string text)
        {
            Kind = kind;
            Text = text;
        }

        /// <summary>What it warns of.</summary>
        public WarningKind Kind { get; }

        /// <summary>The warning's line.</summary>
        public string Text { get; }

        /// <inheritdoc/>
        public override string ToString() => Text;
    }
}
