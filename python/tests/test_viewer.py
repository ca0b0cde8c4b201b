"""Cameras, windows and films of `nbc.evogym`."""

from __future__ import annotations

import os
import signal
import subprocess
import sys

import numpy as np
import pytest

from nbc import evogym

BODY = np.array([[3, 3, 3], [4, 1, 4], [3, 0, 3]])


@pytest.fixture
def sim():
    world = evogym.EvoWorld.of_task("Carrier-v0")
    world.add_from_array("robot", BODY, 1, 1)
    return evogym.EvoSim(world)


@pytest.fixture
def no_display(monkeypatch):
    """Windows of pygame without a display."""
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    monkeypatch.setenv("PYGAME_HIDE_SUPPORT_PROMPT", "1")
    return pytest.importorskip("pygame")


def test_a_camera_draws_what_it_sees(sim):
    viewer = evogym.EvoViewer(sim, pos=(3, 2), view_size=(8, 4), resolution=(160, 80))
    picture = viewer.render("img")
    assert picture.shape == (80, 160, 3) and picture.dtype == np.uint8
    # The ground below the robot, and the sky above it.
    assert picture[70, 90].tolist() == [120, 110, 100] and picture[2, 2].tolist() == [255, 251, 240]
    hidden = viewer.render("rgb_array", hide_background=True, hide_grid=True, hide_edges=True, hide_voxels=True)
    assert (hidden == 255).all()
    viewer.set_pos((30, 100))
    viewer.set_resolution((40, 20))
    assert viewer.render("img", hide_grid=True).reshape(-1, 3).tolist() == [[255, 251, 240]] * 800


def test_a_camera_follows_objects(sim):
    viewer = evogym.EvoViewer(sim, resolution=(200, 100))
    viewer.track_objects("robot", "package")
    viewer.render("img")
    points = np.concatenate([sim.object_pos_at_time(0, name) for name in ("robot", "package")], axis=1)
    np.testing.assert_allclose(viewer.pos, (points.min(axis=1) + points.max(axis=1)) / 2)
    assert viewer.view_size[0] / viewer.view_size[1] == pytest.approx(2)
    start = viewer.pos
    for _ in range(30):
        sim.set_action("robot", np.full(7, 1.6))
        sim.step()
    viewer.render("img")
    assert 0 < np.hypot(*np.subtract(viewer.pos, start)) < 1
    viewer.set_tracking_settings(lock_y=4, padding=(1, 1), scale=(0, 0))
    viewer.render("img")
    assert viewer.pos[1] == 4
    viewer.track_objects()
    viewer.set_view_size((50, 25))
    viewer.render("img")
    assert viewer.view_size == (50, 25)


@pytest.mark.parametrize(
    ("use", "error", "message"),
    [
        (lambda viewer: viewer.render("image"), ValueError, "the render mode is 'image', expected one of 'img'"),
        (lambda viewer: viewer.set_pos([1, 2]), TypeError, "pos is of type list, expected a tuple of two numbers"),
        (lambda viewer: viewer.set_pos((1, np.nan)), ValueError, "expected finite numbers"),
        (lambda viewer: viewer.set_resolution((0, 5)), ValueError, "resolution at 0 is 0.0, expected a whole"),
        (lambda viewer: viewer.set_resolution((60.5, 50)), ValueError, "resolution at 0 is 60.5, expected a whole"),
        (lambda viewer: viewer.set_target_rps(1), ValueError, "target_rps is 1, expected at least 2, or None"),
        (lambda viewer: viewer.track_objects("robt"), ValueError, "no object `robt`; did you mean `robot`?"),
        (lambda viewer: viewer.set_tracking_settings(lock_x=True), ValueError, "expected a finite number or False"),
        (lambda viewer: viewer.set_tracking_settings(lock_x=np.nan), ValueError, "lock_x is nan"),
        (lambda viewer: viewer.set_tracking_settings(zoom=2), ValueError, "there is no setting `zoom`"),
    ],
)
def test_what_a_camera_cannot_do_is_refused(sim, use, error, message):
    with pytest.raises(error, match=message):
        use(evogym.EvoViewer(sim))


def test_a_window_needs_pygame(sim, monkeypatch):
    monkeypatch.setitem(sys.modules, "pygame", None)
    with pytest.raises(ImportError, match='pygame, which is not installed.* "rgb_array" draws pictures without it'):
        evogym.EvoViewer(sim).render("human")


def test_a_window_shows_pictures(sim, no_display):
    viewer = evogym.EvoViewer(sim, target_rps=None, resolution=(60, 30))
    assert viewer.render("screen") is None
    shown = no_display.surfarray.array3d(no_display.display.get_surface()).swapaxes(0, 1)
    np.testing.assert_array_equal(shown, viewer.render("img"))
    viewer.hide_debug_window()
    assert no_display.display.get_surface() is None
    assert viewer.render("human") is None
    viewer.close()


def test_a_window_needs_a_display(sim, monkeypatch):
    pygame = pytest.importorskip("pygame")
    pygame.display.quit()
    monkeypatch.setenv("SDL_VIDEODRIVER", "none of them")
    with pytest.raises(RuntimeError, match='a window cannot be opened: .* draws pictures without a display'):
        evogym.EvoViewer(sim).render("screen")


@pytest.mark.skipif(os.name == "nt", reason="Windows has no signals")
@pytest.mark.parametrize(("before", "status"), [("", -signal.SIGTERM), ("pygame.init()", 1)])
def test_a_script_with_a_window_ends_at_a_signal(before, status):
    """By the signal itself, or by the event that SDL makes of it where the script has begun it."""
    pytest.importorskip("pygame")
    code = f"""
import numpy as np, pygame
from nbc.evogym import EvoSim, EvoViewer, EvoWorld
{before}
world = EvoWorld()
world.add_from_array("robot", np.full((2, 2), 3), 0, 0)
viewer = EvoViewer(EvoSim(world), resolution=(60, 30))
viewer.render("human")
print("shown", flush=True)
while True:
    viewer.render("human")
"""
    silent = {**os.environ, "SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy"}
    # Another test may have shown a window in this process.
    silent.pop("SDL_NO_SIGNAL_HANDLERS", None)
    script = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True, env=silent)
    assert any(line == "shown\n" for line in script.stdout)
    script.send_signal(signal.SIGTERM)
    assert script.wait(timeout=20) == status


def test_the_button_of_a_window_ends_a_script(sim, no_display):
    viewer = evogym.EvoViewer(sim, resolution=(60, 30))
    viewer.render("human")
    no_display.event.post(no_display.event.Event(no_display.QUIT))
    with pytest.raises(SystemExit, match="the window was closed"):
        viewer.render("human")
    assert no_display.display.get_surface() is None


def test_an_environment_shows_each_env_step(no_display):
    gymnasium = pytest.importorskip("gymnasium")
    checker = pytest.importorskip("gymnasium.utils.env_checker")
    import nbc.evogym.envs  # noqa: F401

    env = gymnasium.make("nbc/Walker-v0", body=BODY, render_mode="human")
    viewer = env.unwrapped.default_viewer
    viewer.set_target_rps(None)
    viewer.set_resolution((60, 30))
    env.reset(seed=1)
    first = no_display.surfarray.array3d(no_display.display.get_surface())
    for _ in range(5):
        env.step(np.full(7, 1.6))
    assert (no_display.surfarray.array3d(no_display.display.get_surface()) != first).any()
    assert env.render() is None
    checker.check_env(gymnasium.make("nbc/Walker-v0", body=BODY).unwrapped)
    env.close()
    env.close()


def test_films_are_saved(sim, tmp_path):
    image = pytest.importorskip("PIL.Image")
    viewer = evogym.EvoViewer(sim, resolution=(80, 40))
    pictures = []
    for width in (1.6, 0.6, 1.2):
        sim.set_action("robot", np.full(7, width))
        sim.step()
        pictures.append(viewer.render("img"))
    evogym.save_gif(tmp_path / "walk.gif", pictures, fps=25)
    film = image.open(tmp_path / "walk.gif")
    assert (film.n_frames, film.size, film.info["duration"], film.info["loop"]) == (3, (80, 40), 40, 0)
    with pytest.raises(ValueError, match="the film has no pictures"):
        evogym.save_gif(tmp_path / "none.gif", [])
    with pytest.raises(ValueError, match="fps is 0, expected 0.01 or more"):
        evogym.save_gif(tmp_path / "none.gif", pictures, fps=0)


def test_films_need_pillow(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "PIL", None)
    with pytest.raises(ImportError, match="Pillow writes films, and is not installed"):
        evogym.save_gif(tmp_path / "walk.gif", [np.zeros((2, 2, 3), dtype=np.uint8)])
