namespace Guidewire.Runtime
{
    /// <summary>What steers a wire: a device, a controller, a script. The first enabled component of the loop's object
    /// that has it is asked each frame.</summary>
    public interface IWireInput
    {
        /// <summary>Goes from -1, pull at the loop's full speed, to 1, push.</summary>
        float Push { get; }

        /// <summary>Goes from -1, turn left at the loop's full speed, to 1, turn right.</summary>
        float Turn { get; }
    }
}
