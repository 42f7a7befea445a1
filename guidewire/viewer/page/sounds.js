// @ts-check
/** Soft sounds, where they are switched on: of the pedal, of contrast, and a tone that rises with the force on a wall. */
import { byId } from "./panel.js";

const LOUD = 0.06; // of 1
/** @type {{audio: AudioContext, hum: OscillatorNode, strength: GainNode} | null} */
let made = null;

/** What sounds, where that is wanted; made at the first sound, which follows a hand's press. */
function sounding() {
  if (!byId("sounds")?.checked) return null;
  if (made) return made;
  const audio = new AudioContext();
  const [hum, strength] = [audio.createOscillator(), audio.createGain()];
  strength.gain.value = 0;
  hum.connect(strength).connect(audio.destination);
  hum.start();
  return (made = { audio, hum, strength });
}

/** A short note. @param {number} frequency Hz @param {number} seconds */
export function note(frequency, seconds) {
  const { audio } = sounding() ?? {};
  if (!audio) return;
  const [tone, fade] = [audio.createOscillator(), audio.createGain()];
  tone.frequency.value = frequency;
  fade.gain.setValueAtTime(LOUD, audio.currentTime);
  fade.gain.exponentialRampToValueAtTime(1e-4, audio.currentTime + seconds);
  tone.connect(fade).connect(audio.destination);
  tone.start();
  tone.stop(audio.currentTime + seconds);
}

/** The tone of a force. @param {number} part of the limit at which one should stop; below a half there is none */
export function hum(part) {
  const { audio, hum: tone, strength } = sounding() ?? made ?? {};
  if (!audio || !tone || !strength) return;
  strength.gain.setTargetAtTime(byId("sounds").checked && part > 0.5 ? LOUD * Math.min(1, part) : 0, audio.currentTime, 0.05);
  tone.frequency.setTargetAtTime(180 + 260 * Math.min(2, part), audio.currentTime, 0.05);
}
