// Clips of Caesura in three.js: their names and loops, by the result beside the GLB.
//
//   const gltf = await new GLTFLoader().loadAsync('clips.glb');
//   const clips = prepareClips(gltf.animations, await (await fetch('clips.json')).json());
//   const mixer = new AnimationMixer(gltf.scene);
//   playClip(mixer, clips.get('walk_01'));

import { LoopOnce, LoopRepeat } from 'three';

const SUFFIX = '-loop';

/**
 * The clips by their names without `-loop`, in the order of time: `{ clip, loop, motion, start, end, confidence }`.
 * `animations` are those of a GLTFLoader, `result` is what `caesura segment --json` or `GET …/result.json` say. Animations
 * that are not of this result are left out.
 */
export function prepareClips(animations, result) {
  const clips = new Map();
  for (const clip of animations) {
    const { motion, start, end } = clip.userData.caesura ?? {};
    const segment = result.segments.find((one) => one.start <= start && start < one.end);
    if (segment === undefined) continue;
    const loop = segment.loop || clip.name.endsWith(SUFFIX);
    const name = clip.name.endsWith(SUFFIX) ? clip.name.slice(0, -SUFFIX.length) : clip.name;
    clip.name = name;
    clips.set(name, { clip, loop, motion, start, end, confidence: segment.confidence });
  }
  return clips;
}

/** Play one of them from its beginning: for ever where it loops, else once, standing still in its last pose. */
export function playClip(mixer, { clip, loop }, fadeSeconds = 0.2) {
  const action = mixer.clipAction(clip).reset().setLoop(loop ? LoopRepeat : LoopOnce, Infinity);
  action.clampWhenFinished = !loop;
  return action.fadeIn(fadeSeconds).play();
}
