"""The motions the figures know, as an animator would key them: degrees and metres over one repetition.

Written as differences to the easy stance. Flexion is forward or the way the joint bends, sideways is outward
(trunk: to the left), twist is outward (trunk: to the left); see samples/skeleton.py.
"""

from caesura.samples.repertoire.exercises import JUMP, JUMPING_JACK, KICK, LUNGE, SQUAT
from caesura.samples.repertoire.gaits import LIMP, MARCH, RUN, SNEAK, WALK
from caesura.samples.repertoire.gestures import ARM_CIRCLES, BOW, CLAP, DRINK, LOOK_AROUND, STRETCH, WAVE
from caesura.samples.repertoire.pauses import STILL, T_POSE
from caesura.samples.repertoire.strikes import CHOP, PUNCH, THROW
from caesura.samples.repertoire.trunk_motions import SWAY, TURN, TWIST

__all__ = ["MOTIONS", "STILL", "T_POSE"]

MOTIONS = {
    motion.name: motion
    for motion in (
        WALK, RUN, SNEAK, LIMP, MARCH, JUMP, JUMPING_JACK, SQUAT, LUNGE, KICK, PUNCH, THROW, CHOP, WAVE, CLAP,
        ARM_CIRCLES, STRETCH, LOOK_AROUND, BOW, DRINK, TURN, SWAY, TWIST,
    )
}  # fmt: skip
