"""URDF and SDF files become the body that they mean: the same inertia as in an engine that reads the file itself."""

import numpy as np
import pybullet
import pytest

from neuromech.bodies.pybullet import PyBulletBody
from neuromech.compiler.dynamics import mass_matrix
from neuromech.compiler.kinematics import forward_kinematics
from neuromech.compiler.tree import lower_tree
from neuromech.graph.body_file import read_body_file
from neuromech.graph.model import BodyModel
from neuromech.spec.model import Root
from neuromech.spec.world import World

URDF = """<?xml version="1.0"?>
<robot name="leg">
  <link name="trunk">
    <inertial><origin xyz="0.02 0 0.01"/><mass value="4"/>
      <inertia ixx="0.02" iyy="0.05" izz="0.06" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><geometry><box size="0.3 0.1 0.1"/></geometry></visual>
  </link>
  <link name="thigh">
    <inertial><origin xyz="0.01 -0.04 0.02" rpy="0 0 1.5707963267948966"/><mass value="0.3"/>
      <inertia ixx="0.0004" iyy="0.0005" izz="0.0003" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="shank">
    <inertial><origin xyz="0 0 -0.05"/><mass value="0.2"/>
      <inertia ixx="0.0002" iyy="0.0002" izz="0.00005" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="foot">
    <inertial><origin xyz="0 0 -0.01"/><mass value="0.05"/>
      <inertia ixx="0.00001" iyy="0.00001" izz="0.00001" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0.01 0 -0.02"/><geometry><sphere radius="0.012"/></geometry></collision>
  </link>
  <joint name="hip" type="revolute">
    <parent link="trunk"/><child link="thigh"/><origin xyz="0.1 0.06 -0.02" rpy="1.5707963267948966 0 0"/>
    <axis xyz="0 0 -2"/><limit lower="-1" upper="0.5" effort="10" velocity="5"/><dynamics damping="0.02"/>
  </joint>
  <joint name="knee" type="prismatic">
    <parent link="thigh"/><child link="shank"/><origin xyz="0 -0.1 0" rpy="-1.5707963267948966 0 0"/>
    <axis xyz="0 0.6 0.8"/><limit lower="-0.1" upper="0.1" effort="10" velocity="5"/>
  </joint>
  <joint name="ankle" type="fixed">
    <parent link="shank"/><child link="foot"/><origin xyz="0 0 -0.1"/>
  </joint>
</robot>
"""

SDF = """<sdf version="1.7"><model name="leg">
  <link name="trunk"><pose>1 2 3 0 0 0</pose>
    <inertial><pose>0.02 0 0.01 0 0 0</pose><mass>4</mass>
      <inertia><ixx>0.02</ixx><iyy>0.05</iyy><izz>0.06</izz></inertia></inertial></link>
  <link name="thigh"><pose>1.1 2.06 2.98 1.5707963267948966 0 0</pose>
    <inertial><pose>0.01 -0.04 0.02 0 0 0</pose><mass>0.3</mass>
      <inertia><ixx>0.0005</ixx><iyy>0.0004</iyy><izz>0.0003</izz></inertia></inertial></link>
  <link name="shank"><pose>1.1 2.06 2.83 0 0 0</pose>
    <inertial><mass>0.2</mass><inertia><ixx>0.0002</ixx><iyy>0.0002</iyy><izz>0.00005</izz></inertia></inertial></link>
  <link name="foot"><pose>1.1 2.06 2.78 0 0 0</pose>
    <inertial><pose>0 0 -0.01 0 0 0</pose><mass>0.05</mass>
      <inertia><ixx>0.00001</ixx><iyy>0.00001</iyy><izz>0.00001</izz></inertia></inertial>
    <collision name="ball"><pose>0.01 0 -0.02 0 0 0</pose><geometry><sphere><radius>0.012</radius></sphere></geometry>
    </collision></link>
  <joint name="hip" type="revolute"><parent>trunk</parent><child>thigh</child>
    <axis><xyz>0 0 -2</xyz><limit><lower>-1</lower><upper>0.5</upper></limit>
      <dynamics><damping>0.02</damping></dynamics></axis></joint>
  <joint name="knee" type="prismatic"><pose>0 0 0.05 0 0 0</pose><parent>thigh</parent><child>shank</child>
    <axis><xyz>0 0.6 0.8</xyz><limit><lower>-0.1</lower><upper>0.1</upper></limit></axis></joint>
  <joint name="ankle" type="fixed"><parent>shank</parent><child>foot</child></joint>
</model></sdf>
"""


def read(folder, text, name="leg.urdf"):
    file = folder / name
    file.write_text(text, encoding="utf-8")
    return read_body_file(file)


def body_of(parts, root="free"):
    segments, joints, contacts = parts
    return BodyModel("pybullet", None, Root(kind=root), "trunk", segments, joints, contacts, World())


def inertia_of(body, angles):
    tree = lower_tree(body)
    rotation, position = np.zeros((len(tree.segments), 3, 3)), np.zeros((len(tree.segments), 3))
    pose = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
    forward_kinematics(tree.topology, tree.geometry, angles, pose, rotation, position)
    return mass_matrix(tree, rotation, position)


def test_urdf_has_the_inertia_that_bullet_reads_from_the_same_file(tmp_path):
    body = body_of(read(tmp_path, URDF), root="fixed")
    client = pybullet.connect(pybullet.DIRECT)
    try:
        robot = pybullet.loadURDF(
            str(tmp_path / "leg.urdf"),
            useFixedBase=True,
            flags=pybullet.URDF_USE_INERTIA_FROM_FILE,
            physicsClientId=client,
        )
        expected = np.array(pybullet.calculateMassMatrix(robot, [0.3, 0.05], physicsClientId=client))
    finally:
        pybullet.disconnect(client)
    assert inertia_of(body, np.array([0.3, 0.05])) == pytest.approx(expected, rel=1e-9)


def test_engine_moves_the_body_of_a_file(tmp_path):
    body = body_of(read(tmp_path, URDF))
    with PyBulletBody(body, 1e-3) as opened:
        state = np.zeros(opened.layout.size)
        opened.step(np.zeros(2))
        opened.read(state)
    assert (opened.joints, opened.contacts) == (("hip", "knee"), ("foot_contact",))
    assert state[opened.layout.root_velocity][2] == pytest.approx(-9.81e-3)


def test_urdf_frames_take_the_axes_of_the_root(tmp_path):
    segments, joints, contacts = read(tmp_path, URDF)
    assert list(segments) == ["trunk", "thigh", "shank"]
    assert segments["thigh"].center_of_mass == pytest.approx((0.01, -0.02, -0.04), abs=1e-12)
    assert segments["thigh"].inertia == pytest.approx((5e-4, 3e-4, 4e-4), rel=1e-9)
    assert joints["hip"].axis == pytest.approx((0.0, 1.0, 0.0), abs=1e-12)
    assert joints["hip"].position == pytest.approx((0.1, 0.06, -0.02))
    assert joints["hip"].range == (-1.0, 0.5)
    assert joints["hip"].damping == 0.02
    assert joints["knee"].kind == "slide"
    assert joints["knee"].position == pytest.approx((0.0, 0.0, -0.1), abs=1e-12)
    assert contacts["foot_contact"].segment == "shank"
    assert contacts["foot_contact"].position == pytest.approx((0.01, 0.0, -0.12), abs=1e-12)


def test_fixed_links_become_one_segment(tmp_path):
    segments, _, _ = read(tmp_path, URDF)
    shank = segments["shank"]
    assert shank.mass == pytest.approx(0.25)
    assert shank.center_of_mass[2] == pytest.approx((0.2 * -0.05 + 0.05 * -0.11) / 0.25)
    reduced = 0.2 * 0.05 / 0.25
    assert shank.inertia == pytest.approx((2.1e-4 + reduced * 0.06**2, 2.1e-4 + reduced * 0.06**2, 6e-5), rel=1e-9)


def test_sdf_and_urdf_of_one_robot_are_one_body(tmp_path):
    from_urdf = read(tmp_path, URDF)
    from_sdf = read(tmp_path, SDF, "leg.sdf")
    for one, other in zip(from_urdf, from_sdf, strict=True):
        assert list(one) == list(other)
        for name in one:
            for field, value in one[name]:
                found = getattr(other[name], field)
                if isinstance(value, str | None):
                    assert found == value, (name, field)
                else:
                    assert found == pytest.approx(value, abs=1e-12), (name, field)


def test_a_joint_off_its_sdf_link_moves_the_frame_not_the_body(tmp_path):
    body = body_of(read(tmp_path, SDF, "leg.sdf"), root="fixed")
    moved = SDF.replace("<pose>0 0 0.05 0 0 0</pose>", "<pose>0 0 0.01 0 0 0</pose>")
    other = body_of(read(tmp_path, moved, "leg.sdf"), root="fixed")
    assert body.joints["knee"].position != other.joints["knee"].position
    assert inertia_of(other, np.array([0.2, 0.0])) == pytest.approx(inertia_of(body, np.array([0.2, 0.0])), rel=1e-9)


def test_unlimited_joints_have_no_range(tmp_path):
    _, joints, _ = read(tmp_path, URDF.replace('type="revolute"', 'type="continuous"'))
    assert joints["hip"].range is None
    _, joints, _ = read(tmp_path, SDF.replace("<lower>-1</lower><upper>0.5</upper>", ""), "leg.sdf")
    assert joints["hip"].range is None


BOMB = '<!DOCTYPE r [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;">]><robot name="leg">&b;</robot>'
FOREIGN = '<!DOCTYPE r [<!ENTITY x SYSTEM "file:///etc/hostname">]><robot name="leg">&x;</robot>'


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (URDF, "", "is not well-formed XML"),
        (URDF, BOMB, "has a document type declaration"),
        (URDF, FOREIGN, "has a document type declaration"),
        (URDF, "<mujoco/>", "neither URDF (<robot>) nor SDF (<sdf>) but <mujoco>"),
        (URDF, "<robot/>", "has no links"),
        ('type="revolute"', 'type="floating"', "joint 'hip' has a type that is not supported (got 'floating'"),
        ('<link name="foot">', '<link name="shank">', "has two links with the name 'shank'"),
        ('<parent link="shank"/>', '<parent link="shnak"/>', "did you mean 'shank'?"),
        ('<parent link="trunk"/>', '<parent link="foot"/>', "joints close a cycle"),
        ('<child link="foot"/>', '<child link="thigh"/>', "link 'thigh' is the child of two joints"),
        ('<mass value="0.3"/>', '<mass value="nan"/>', "mass of link 'thigh' must be a finite number (got 'nan')"),
        ('<mass value="0.3"/>', '<mass value="0"/>', "link 'thigh' needs a mass"),
        ('ixx="0.02"', 'ixx="-0.02"', "link 'trunk' needs moments of inertia greater than zero"),
        ('ixy="0"', 'ixy="0.01"', "principal axes of inertia of link 'trunk' are not parallel"),
        ('<sphere radius="0.012"/>', '<box size="1 1 1"/>', "link 'foot' has a collision shape that is no sphere"),
        ('<axis xyz="0 0 -2"/>', '<axis xyz="0 0 0"/>', "the axis of joint 'hip' has no direction"),
        ('<axis xyz="0 0 -2"/>', '<axis xyz="0 0"/>', "axis of joint 'hip' must be 3 finite numbers (got '0 0')"),
        ('lower="-1"', 'lower="1"', "joint 'hip' needs a lower limit below its upper one"),
        ('<dynamics damping="0.02"/>', '<dynamics friction="1"/>', "joint 'hip' has dry friction"),
        ('<dynamics damping="0.02"/>', '<mimic joint="knee"/>', "joint 'hip' mimics another joint"),
        ('name="knee"', 'name="the/knee"', "the name 'the/knee' must start with a letter"),
    ],
)
def test_what_is_wrong_with_a_urdf_is_said(tmp_path, old, new, message):
    text = URDF.replace(old, new, 1)
    assert text != URDF
    with pytest.raises(ValueError) as error:
        read(tmp_path, text)
    assert "'leg.urdf'" in str(error.value)
    assert message in str(error.value)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("<parent>trunk</parent>", "<parent>world</parent>", "joint 'hip' holds the model to the world"),
        ('<model name="leg">', '<model name="other"></model><model name="leg">', "exactly one model (got 2)"),
        ("<pose>1 2 3 0 0 0</pose>", '<pose relative_to="thigh">1 2 3 0 0 0</pose>', "is not supported"),
        ("<pose>1 2 3 0 0 0</pose>", "<pose>1 2 3</pose>", "pose of link 'trunk' must be 6 finite numbers"),
        ("<xyz>0 0 -2</xyz>", "<use_parent_model_frame>1</use_parent_model_frame>", "use_parent_model_frame"),
        ('type="revolute"', 'type="ball"', "joint 'hip' has a type that is not supported (got 'ball'"),
        ("<radius>0.012</radius>", "", "radius of a sphere of link 'foot' must be a finite number"),
    ],
)
def test_what_is_wrong_with_an_sdf_is_said(tmp_path, old, new, message):
    text = SDF.replace(old, new, 1)
    assert text != SDF
    with pytest.raises(ValueError) as error:
        read(tmp_path, text, "leg.sdf")
    assert message in str(error.value)


def test_a_file_that_is_not_there_is_said(tmp_path):
    with pytest.raises(ValueError, match=r"'none\.urdf' cannot be read"):
        read_body_file(tmp_path / "none.urdf")


def test_a_binary_file_is_no_body(tmp_path):
    file = tmp_path / "leg.urdf"
    file.write_bytes(bytes(range(256)))
    with pytest.raises(ValueError, match="not well-formed"):
        read_body_file(file)
