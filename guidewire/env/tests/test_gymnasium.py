"""Gymnasium's own classes over the environments, where it can be imported; its source is not shipped."""

import numpy as np
import pytest

from guidewire.env import Drive, Environment, Observation, Picture, VectorEnvironment
from guidewire.env.tests.environment_cases import tube  # noqa: F401

gymnasium = pytest.importorskip("gymnasium", reason="gymnasium is not installed")
from gymnasium import wrappers  # noqa: E402
from gymnasium.utils.env_checker import check_env  # noqa: E402
from gymnasium.vector import AsyncVectorEnv, SyncVectorEnv  # noqa: E402
from gymnasium.wrappers import vector as vector_wrappers  # noqa: E402

FLAT = Observation(flat=True, normalised=True)
KINDS = (Observation(), FLAT, Observation(history=3), Observation(parts=("hub",), image=Picture(pixels=16)))


def played(made, steps=25):
    """Steps over the ends of episodes; the sum of what they earn."""
    made.reset(seed=3)
    made.action_space.seed(3)
    total = 0.0
    for _ in range(steps):
        _, earned, terminated, truncated, _ = made.step(made.action_space.sample())
        total += np.sum(earned)
        if not isinstance(made, gymnasium.vector.VectorEnv) and (terminated or truncated):
            made.reset()
    made.close()
    return total


@pytest.mark.filterwarnings("ignore:.*A Box observation space")
@pytest.mark.parametrize("actions", ("continuous", "discrete"))
@pytest.mark.parametrize("kind", KINDS)
def test_the_checker_passes_for_each_kind(tube, kind, actions):
    check_env(Environment(tube, observation=kind, drive=Drive(actions=actions), render_mode="rgb_array"))


@pytest.mark.parametrize("wrap", (
    wrappers.RecordEpisodeStatistics, wrappers.NormalizeObservation, wrappers.NormalizeReward,
    lambda made: wrappers.FrameStackObservation(made, 4), lambda made: wrappers.DelayObservation(made, 2),
    lambda made: wrappers.TimeAwareObservation(wrappers.TimeLimit(made, 10)),
    lambda made: wrappers.RescaleAction(made, np.float32(-2.0), np.float32(2.0)),
    lambda made: wrappers.MaxAndSkipObservation(made, 2), wrappers.PassiveEnvChecker, wrappers.RenderCollection,
    lambda made: wrappers.AddRenderObservation(made, render_only=True),
))
def test_wrappers_go_over_an_environment(tube, wrap):
    assert np.isfinite(played(wrap(Environment(tube, observation=FLAT, render_mode="rgb_array"))))


@pytest.mark.parametrize("mode", ("NextStep", "SameStep"))
def test_vector_classes_earn_what_ours_does(tube, mode):
    mode = gymnasium.vector.AutoresetMode(mode)
    several = [SyncVectorEnv([lambda: Environment(tube, observation=FLAT)] * 2, autoreset_mode=mode),
               AsyncVectorEnv([lambda: Environment(tube, observation=FLAT)] * 2, autoreset_mode=mode),
               VectorEnvironment(tube, 2, observation=FLAT, autoreset_mode=mode)]
    earned = [played(one, 60) for one in several]
    assert earned[0] == earned[1] == earned[2]


@pytest.mark.parametrize("wrap", (
    vector_wrappers.RecordEpisodeStatistics, vector_wrappers.NormalizeObservation, vector_wrappers.NormalizeReward,
    vector_wrappers.DictInfoToList, lambda made: vector_wrappers.RescaleAction(made, -2.0, 2.0),
))
def test_wrappers_go_over_several(tube, wrap):
    played(wrap(VectorEnvironment(tube, 2, observation=FLAT)))


def test_a_spec_is_json_with_its_options_and_makes_the_same_environment():
    from gymnasium.envs.registration import EnvSpec

    with gymnasium.make("guidewire/artery-v0", observation={"flat": True}, drive={"actions": "discrete"}) as made:
        with gymnasium.make(EnvSpec.from_json(made.spec.to_json())) as again:
            assert again.observation_space == made.observation_space and again.action_space == made.action_space
        assert made.spec.max_episode_steps == 70 and made.spec.reward_threshold == pytest.approx(1.804)


def test_stable_baselines_checks_and_learns(tube):
    stable = pytest.importorskip("stable_baselines3", reason="stable_baselines3 is not installed")
    from stable_baselines3.common.env_checker import check_env as check
    from stable_baselines3.common.env_util import make_vec_env

    check(Environment(tube, observation=FLAT))
    several = make_vec_env(lambda: Environment(tube, observation=FLAT), 2)
    stable.PPO("MlpPolicy", several, n_steps=32, batch_size=32).learn(64)
    several.close()
