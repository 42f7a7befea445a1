// The surface of wires, catheters and walls, lit from the camera: it needs no light of the scene, so that it looks the
// same in every pipeline. Its pass has no light mode: the built-in pipeline draws it as any shader, URP as one of the
// kind SRPDefaultUnlit. Colours are premultiplied by alpha.
Shader "Guidewire/Surface"
{
    Properties
    {
        _Color ("Colour", Color) = (1, 1, 1, 1)
        _MainTex ("Texture", 2D) = "white" {}
        [HideInInspector] _SrcBlend ("Source factor", Float) = 1
        [HideInInspector] _DstBlend ("Destination factor", Float) = 0
        [HideInInspector] _ZWrite ("Depth is written", Float) = 1
    }
    SubShader
    {
        Tags { "RenderType" = "Opaque" }
        Pass
        {
            Blend [_SrcBlend] [_DstBlend]
            ZWrite [_ZWrite]

            CGPROGRAM
            #pragma vertex Vertex
            #pragma fragment Fragment
            #pragma multi_compile_instancing
            #include "UnityCG.cginc"

            sampler2D _MainTex;
            fixed4 _Color;

            struct Input
            {
                float4 position : POSITION;
                float3 normal : NORMAL;
                float2 uv : TEXCOORD0;
                UNITY_VERTEX_INPUT_INSTANCE_ID
            };

            struct Varying
            {
                float4 position : SV_POSITION;
                float3 normal : TEXCOORD0;
                float3 toCamera : TEXCOORD1;
                float2 uv : TEXCOORD2;
                UNITY_VERTEX_OUTPUT_STEREO
            };

            Varying Vertex(Input input)
            {
                Varying output;
                UNITY_SETUP_INSTANCE_ID(input);
                UNITY_INITIALIZE_VERTEX_OUTPUT_STEREO(output);
                float3 place = mul(unity_ObjectToWorld, float4(input.position.xyz, 1)).xyz;
                output.position = mul(UNITY_MATRIX_VP, float4(place, 1));
                output.normal = any(input.normal) ? UnityObjectToWorldNormal(input.normal) : 0;
                output.toCamera = UnityWorldSpaceViewDir(place);
                output.uv = input.uv;
                return output;
            }

            fixed4 Fragment(Varying input) : SV_Target
            {
                // A line has no normals: it is lit as if it faced the camera.
                float size = length(input.normal);
                float facing = size > 0 ? saturate(dot(input.normal / size, normalize(input.toCamera))) : 1;
                fixed4 colour = _Color * tex2D(_MainTex, input.uv);
                float3 lit = colour.rgb * (0.35 + 0.65 * facing) + 0.15 * pow(facing, 40);
                return fixed4(lit * colour.a, colour.a);
            }
            ENDCG
        }
    }
}
