namespace Guidewire.Core
{
    /// <summary>A step that can say which forces act on the wire from outside.</summary>
    internal interface IContactStep
    {
        /// <summary>The forces of the last step; null where nobody asked for them.</summary>
        ContactRecord? Record { get; }
    }
}
