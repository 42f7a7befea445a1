using System;

namespace UnityEngine
{
    public struct Vector2
    {
        public float x;
        public float y;

        public Vector2(float x, float y)
        {
            this.x = x;
            this.y = y;
        }
    }

    public struct Vector3
    {
        public float x;
        public float y;
        public float z;

        public Vector3(float x, float y, float z)
        {
            this.x = x;
            this.y = y;
            this.z = z;
        }

        public static Vector3 zero => new Vector3(0f, 0f, 0f);

        public static Vector3 one => new Vector3(1f, 1f, 1f);

        public static Vector3 forward => new Vector3(0f, 0f, 1f);

        public static Vector3 up => new Vector3(0f, 1f, 0f);

        public static Vector3 right => new Vector3(1f, 0f, 0f);

        public float sqrMagnitude => x * x + y * y + z * z;

        public float magnitude => (float)Math.Sqrt(sqrMagnitude);

        public Vector3 normalized
        {
            get
            {
                float length = magnitude;
                return length > 1e-5f ? this / length : zero;
            }
        }

        public static Vector3 operator +(Vector3 a, Vector3 b) => new Vector3(a.x + b.x, a.y + b.y, a.z + b.z);

        public static Vector3 operator -(Vector3 a, Vector3 b) => new Vector3(a.x - b.x, a.y - b.y, a.z - b.z);

        public static Vector3 operator -(Vector3 a) => new Vector3(-a.x, -a.y, -a.z);

        public static Vector3 operator *(float s, Vector3 a) => new Vector3(s * a.x, s * a.y, s * a.z);

        public static Vector3 operator *(Vector3 a, float s) => s * a;

        public static Vector3 operator /(Vector3 a, float s) => new Vector3(a.x / s, a.y / s, a.z / s);

        public static float Dot(Vector3 a, Vector3 b) => a.x * b.x + a.y * b.y + a.z * b.z;

        public static Vector3 Cross(Vector3 a, Vector3 b) =>
            new Vector3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);

        public static float Distance(Vector3 a, Vector3 b) => (a - b).magnitude;
    }

    public struct Quaternion
    {
        public float x;
        public float y;
        public float z;
        public float w;

        public Quaternion(float x, float y, float z, float w)
        {
            this.x = x;
            this.y = y;
            this.z = z;
            this.w = w;
        }

        public static Quaternion identity => new Quaternion(0f, 0f, 0f, 1f);

        public static Quaternion Inverse(Quaternion rotation) =>
            new Quaternion(-rotation.x, -rotation.y, -rotation.z, rotation.w);

        /// <summary>Degrees, applied about z, then x, then y.</summary>
        public static Quaternion Euler(float x, float y, float z) =>
            About(Vector3.up, y) * About(Vector3.right, x) * About(Vector3.forward, z);

        public static Quaternion FromToRotation(Vector3 from, Vector3 to)
        {
            Vector3 a = from.normalized;
            Vector3 b = to.normalized;
            float dot = Vector3.Dot(a, b);
            if (dot < -0.999999f)
            {
                Vector3 axis = Vector3.Cross(a, Math.Abs(a.x) < 0.9f ? Vector3.right : Vector3.up).normalized;
                return new Quaternion(axis.x, axis.y, axis.z, 0f);
            }
            Vector3 c = Vector3.Cross(a, b);
            float s = (float)Math.Sqrt(2.0 * (1.0 + dot));
            return new Quaternion(c.x / s, c.y / s, c.z / s, 0.5f * s);
        }

        public static Quaternion operator *(Quaternion a, Quaternion b)
        {
            return new Quaternion(
                a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z,
                a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x,
                a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z);
        }

        public static Vector3 operator *(Quaternion q, Vector3 v)
        {
            var u = new Vector3(q.x, q.y, q.z);
            return v + 2f * Vector3.Cross(u, Vector3.Cross(u, v) + q.w * v);
        }

        private static Quaternion About(Vector3 axis, float degrees)
        {
            double half = degrees * Math.PI / 360.0;
            Vector3 v = (float)Math.Sin(half) * axis;
            return new Quaternion(v.x, v.y, v.z, (float)Math.Cos(half));
        }
    }

    /// <summary>An affine map: its three columns, and where it takes the origin.</summary>
    public struct Matrix4x4
    {
        internal Vector3 position;
        internal Vector3 x;
        internal Vector3 y;
        internal Vector3 z;

        public static Matrix4x4 identity => TRS(Vector3.zero, Quaternion.identity, Vector3.one);

        public static Matrix4x4 TRS(Vector3 pos, Quaternion q, Vector3 s)
        {
            return new Matrix4x4
            {
                position = pos, x = s.x * (q * Vector3.right), y = s.y * (q * Vector3.up),
                    z = s.z * (q * Vector3.forward),
            };
        }

        public static Matrix4x4 operator *(Matrix4x4 lhs, Matrix4x4 rhs)
        {
            return new Matrix4x4
            {
                position = lhs.MultiplyPoint3x4(rhs.position), x = lhs.MultiplyVector(rhs.x),
                y = lhs.MultiplyVector(rhs.y), z = lhs.MultiplyVector(rhs.z),
            };
        }

        public Matrix4x4 inverse
        {
            get
            {
                Vector3 a = Vector3.Cross(y, z);
                Vector3 b = Vector3.Cross(z, x);
                Vector3 c = Vector3.Cross(x, y);
                float scale = 1f / Vector3.Dot(x, a);
                var back = new Matrix4x4
                {
                    x = scale * new Vector3(a.x, b.x, c.x), y = scale * new Vector3(a.y, b.y, c.y),
                    z = scale * new Vector3(a.z, b.z, c.z),
                };
                back.position = -back.MultiplyVector(position);
                return back;
            }
        }

        public Vector3 MultiplyPoint3x4(Vector3 point) => position + MultiplyVector(point);

        public Vector3 MultiplyVector(Vector3 vector) => vector.x * x + vector.y * y + vector.z * z;
    }

    public struct Color
    {
        public float r;
        public float g;
        public float b;
        public float a;

        public Color(float r, float g, float b)
            : this(r, g, b, 1f)
        {
        }

        public Color(float r, float g, float b, float a)
        {
            this.r = r;
            this.g = g;
            this.b = b;
            this.a = a;
        }

        public static Color Lerp(Color a, Color b, float t)
        {
            return new Color(Mathf.Lerp(a.r, b.r, t), Mathf.Lerp(a.g, b.g, t), Mathf.Lerp(a.b, b.b, t),
                Mathf.Lerp(a.a, b.a, t));
        }
    }

    public struct Color32
    {
        public byte r;
        public byte g;
        public byte b;
        public byte a;

        public Color32(byte r, byte g, byte b, byte a)
        {
            this.r = r;
            this.g = g;
            this.b = b;
            this.a = a;
        }

        public static implicit operator Color32(Color c)
        {
            return new Color32((byte)Math.Round(255f * c.r), (byte)Math.Round(255f * c.g), (byte)Math.Round(255f * c.b),
                (byte)Math.Round(255f * c.a));
        }
    }

    public struct Bounds
    {
        public Bounds(Vector3 center, Vector3 size)
        {
            this.center = center;
            this.size = size;
        }

        public Vector3 center { get; set; }

        public Vector3 size { get; set; }
    }

    public struct Rect
    {
        public Rect(float x, float y, float width, float height)
        {
            this.x = x;
            this.y = y;
            this.width = width;
            this.height = height;
        }

        public float x { get; set; }

        public float y { get; set; }

        public float width { get; set; }

        public float height { get; set; }
    }

    public static class Mathf
    {
        public const float PI = 3.14159274f;

        public const float Rad2Deg = 57.29578f;

        public static float Atan2(float y, float x) => (float)Math.Atan2(y, x);

        public static float DeltaAngle(float current, float target)
        {
            float delta = target - current - 360f * (float)Math.Floor((target - current) / 360f);
            return delta > 180f ? delta - 360f : delta;
        }

        public static float Abs(float f) => Math.Abs(f);

        public static float Cos(float f) => (float)Math.Cos(f);

        public static float Exp(float f) => (float)Math.Exp(f);

        public static float Max(float a, float b) => a > b ? a : b;

        public static float Min(float a, float b) => a < b ? a : b;

        public static float Sin(float f) => (float)Math.Sin(f);

        public static float Sqrt(float f) => (float)Math.Sqrt(f);

        public static float Clamp(float value, float min, float max) => value < min ? min : value > max ? max : value;

        public static float Lerp(float a, float b, float t) => a + (b - a) * Clamp(t, 0f, 1f);
    }
}
