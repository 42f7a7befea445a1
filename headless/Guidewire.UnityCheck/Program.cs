using System.Text.Encodings.Web;
using System.Text.Json;

namespace Guidewire.UnityCheck
{
    /// <summary>Reads requests, one JSON object a line, and answers each with one line, until there are no more.
    /// </summary>
    public static class Program
    {
        private static readonly JsonSerializerOptions Form = new JsonSerializerOptions
        {
            PropertyNamingPolicy = JsonNamingPolicy.CamelCase,
            Encoder = JavaScriptEncoder.UnsafeRelaxedJsonEscaping,
        };

        public static int Main()
        {
            var checker = new Checker();
            for (string? line = Console.In.ReadLine(); line != null; line = Console.In.ReadLine())
            {
                Request request = JsonSerializer.Deserialize<Request>(line, Form)
                    ?? throw new InvalidOperationException("an empty request");
                Console.Out.WriteLine(JsonSerializer.Serialize(checker.Check(request), Form));
                Console.Out.Flush();
            }
            return 0;
        }
    }
}
