// @ts-check
/** How walls, wires and marks look in 3D: wet tissue whose near side is clear, metal, and light. */
import {
  AdditiveBlending, BackSide, DataTexture, DoubleSide, FrontSide, Group, Mesh, MeshBasicMaterial, MeshMatcapMaterial,
  ShaderMaterial, Sprite, SpriteMaterial, TorusGeometry, Vector3,
} from "three";

const CORNERS = `varying vec3 normalSeen, towards, place;
void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  normalSeen = normalMatrix * normal;
  towards = -seen.xyz;
  place = position;
  gl_Position = projectionMatrix * seen;
}`;

/** Of the far side one sees the dark inside. The near side is clear where it faces the eye, and solid at its rim, with a
 * gloss where light from the upper left is mirrored. */
const TISSUE = `uniform float inside, size;
varying vec3 normalSeen, towards, place;
float wave(vec3 p) {
  return sin(p.x * 1.1 + 1.9 * sin(p.y * 0.7 + 0.4)) + sin(p.y * 0.8 + 1.7 * sin(p.z * 0.9)) + sin(p.z * 1.2 + 1.5 * sin(p.x * 0.8 + 1.1));
}
void main() {
  vec3 v = normalize(towards), n = normalize(normalSeen);
  if (dot(n, v) < 0.0) n = -n;
  vec3 key = normalize(vec3(-0.5, 0.75, 0.55)), p = place / size * 2.2;
  float facing = clamp(dot(n, v), 0.0, 1.0), rim = pow(1.0 - facing, 2.4), fold = wave(p);
  float lit = smoothstep(-0.55, 1.0, dot(n, key)), mirrored = clamp(dot(n, normalize(key + v)), 0.0, 1.0);
  float gloss = pow(mirrored, 90.0), sheen = pow(mirrored, 9.0);
  float veins = smoothstep(0.16, 0.0, abs(fold)) * smoothstep(-0.6, 0.8, wave(p * 0.37 + 3.0));
  vec3 base = mix(vec3(0.40, 0.05, 0.07), vec3(0.90, 0.34, 0.30), lit) * (1.0 + 0.05 * fold);
  base = mix(base, vec3(0.42, 0.05, 0.10), 0.35 * veins) + 0.10 * rim * vec3(1.0, 0.7, 0.6);
  if (inside > 0.5) gl_FragColor = vec4(base * (0.42 + 0.30 * lit) + 0.12 * gloss, 1.0);
  else gl_FragColor = vec4(base * (1.0 + 0.25 * rim) + vec3(1.0, 0.71, 0.61) * (0.3 * rim * rim + 0.12 * sheen) + 0.75 * gloss,
    clamp(0.10 + 0.85 * rim + 0.8 * gloss + 0.16 * sheen + 0.12 * veins, 0.0, 1.0));
}`;

/** Light on what is seen from the side. */
const RIM = `uniform vec3 colour;
uniform float strength, sharp;
varying vec3 normalSeen, towards, place;
void main() { gl_FragColor = vec4(colour, strength * pow(1.0 - abs(dot(normalize(normalSeen), normalize(towards))), sharp)); }`;

/** A side of a vessel's wall, whose triangles face the lumen. @param {boolean} isFar @param {number} size units of a fold */
export const tissue = (isFar, size) => new ShaderMaterial({ vertexShader: CORNERS, fragmentShader: TISSUE, transparent: !isFar,
  depthWrite: isFar, side: isFar ? FrontSide : BackSide, uniforms: { inside: { value: Number(isFar) }, size: { value: size } } });

/** @param {import("three").Color} colour @param {number} strength @param {number} sharp exponent */
export const rimOfLight = (colour, strength, sharp) => new ShaderMaterial({ vertexShader: CORNERS, fragmentShader: RIM, transparent: true,
  depthWrite: false, side: DoubleSide, uniforms: { colour: { value: colour }, strength: { value: strength }, sharp: { value: sharp } } });

/** A small picture. @param {(x: number, y: number) => number[]} of red, green, blue and alpha from 0 to 1, of -1 to 1 */
function texture(of) {
  const side = 64;
  const bytes = Uint8Array.from({ length: 4 * side * side }, (_, k) => {
    const [x, y] = [(k >> 2) % side, Math.floor(k / (4 * side))].map((at) => (2 * at + 1) / side - 1);
    return 255 * Math.max(0, Math.min(1, of(x, y)[k & 3]));
  });
  const made = new DataTexture(bytes, side, side);
  made.magFilter = 1006; // linear
  made.needsUpdate = true;
  return made;
}

/** Steel under a window and over a dark floor, by the direction of the surface. */
const steel = texture((x, y) => {
  const light = 0.65 + 0.5 * Math.exp(-(((y - 0.25 + 0.3 * x) / 0.3) ** 2)) + 0.45 * Math.exp(-(((y + 0.7) / 0.18) ** 2)) + 0.25 * y;
  return [light, light, light * 1.02, 1];
});
const halo = texture((x, y) => [1, 1, 1, Math.max(0, 1 - Math.hypot(x, y)) ** 2.2]);

/** Metal in the colours of its surface. @param {object} [more] */
export const metal = (more) => new MeshMatcapMaterial({ matcap: steel, vertexColors: true, ...more });

/** A light around a place. @param {number} colour */
export const glow = (colour) => {
  const made = new Sprite(new SpriteMaterial({ map: halo, color: colour, blending: AdditiveBlending, transparent: true, depthTest: false, depthWrite: false }));
  made.renderOrder = 6;
  return made;
};

/** Two rings around the lumen at a target. @param {import("./target.js").Route} route */
export function ringAt({ points, radii }) {
  const [before, at] = [points.at(-4) ?? points[0], points.at(-1) ?? [0, 0, 0]].map((one) => new Vector3().fromArray(one));
  const radius = radii.at(-1) ?? 1;
  const group = new Group();
  for (const [grown, thin] of [[1.25, 0.11], [1.75, 0.045]]) {
    group.add(new Mesh(new TorusGeometry(radius * grown, radius * thin, 10, 48), new MeshBasicMaterial({ color: 0x3ee6a0 })));
  }
  const light = glow(0x1f8f60);
  light.scale.setScalar(5.5 * radius);
  group.add(light);
  group.position.copy(at);
  group.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), at.clone().sub(before).normalize());
  return group;
}
