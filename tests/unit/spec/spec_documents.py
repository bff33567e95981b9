"""A document that uses most of what a document may say."""

HALF_CENTRE = """\
neuromech: 1
name: half centre
parameters:
  drive: {value: 2.05, minimum: 0, maximum: 3}
  rhythm_time: {value: 300 ms}
modules:
  leg:
    arguments:
      tau: {default: "${rhythm_time}"}
      other:
      hip: {default: [10 mm, 20 mm, 0 mm]}
    network:
      neurons:
        RG-F: {kind: rybak_neuron, sodium_conductance: 3.5 nS, maximal_inactivation_time: "${tau}"}
        In: {kind: rybak_interneuron}
      synapses:
        excitatory:
          RG-F: {In: 0.4}
        interlimb:
          RG-F: {"${other}.RG-F": 0.1}
    body:
      segments:
        thigh:
          mass: 200 g
          inertia: [1e-4 kg m^2, 1e-4 kg m^2, 1e-5 kg m^2]
          center_of_mass: [0 mm, -5 mm, -30 mm]
      joints:
        hip: {parent: trunk, child: thigh, position: "${hip}", axis: [0.1, 1, 0.2]}
instances:
  LF: {use: leg, with: {other: RF}}
  RF: {mirror: LF, with: {other: LF}}
network:
  drives:
    MLR: {kind: descending_drive, strength: "${drive}"}
  synapses:
    excitatory:
      MLR: {LF.RG-F: 0.1, RF.RG-F: 0.1}
body:
  engine: hinge
  segments:
    trunk: {mass: 1 kg, inertia: [1e-3 kg m^2, 1e-3 kg m^2, 1e-3 kg m^2]}
protocol:
  duration: 2 s
record:
  all: {signals: ["*"], every: 1 ms}
"""
