! Stands in for Abaqus: presses one contact point through one cycle of section 4 and prints the
! wear; then the error of dp/dh against a difference quotient.
program stub
  use, intrinsic :: iso_fortran_env, only: dp => real64
  implicit none
  real(dp), parameter :: pi = acos(-1.0_dp), T = 0.06_dp, swing = 5.0e-4_dp, apart = 1.0e-8_dp
  real(dp), parameter :: props(7) = [300.0_dp, 1.08e-3_dp, 3.6e-4_dp, 1.0e-6_dp, 200.0_dp, &
    0.25_dp, 22 * 2000 * pi / 30]
  integer, parameter :: increments = 4000
  real(dp) :: statev(2), p, stiffness, more, less, unused
  integer :: i

  statev = 0
  do i = 1, increments
    call press(swing * sin(2 * pi * (i - 0.5_dp) / increments), T / increments, p, stiffness)
  end do
  print '(a, es11.5, a)', 'wear after one cycle: ', statev(1), ' mm'

  statev = 0
  call press(swing, 0.0_dp, p, stiffness)
  call press(swing + apart, 0.0_dp, more, unused)
  call press(swing - apart, 0.0_dp, less, unused)
  print '(a, f8.4, a, l1)', 'pressure ', p, ' MPa, stiffness right: ', &
    abs((more - less) / (2 * apart) / stiffness - 1) < 1.0e-6_dp

contains

  subroutine press(approach, dtime, pressure, stiffness)
    real(dp), intent(in) :: approach, dtime
    real(dp), intent(out) :: pressure, stiffness
    real(dp) :: stress(2), ddsddr(2, 2), zero, two(2), table(2, 2), rdisp(2)
    character(80) :: name
    integer :: none
    name = ' '
    stress = 0
    ddsddr = 0
    zero = 0
    two = 0
    table = 0
    none = 0
    rdisp = [approach, 0.0_dp]
    call uinter(stress, ddsddr, table, table, two, table, table, table, statev, zero, zero, &
      zero, zero, zero, zero, rdisp, two, two, two, table, table, two, dtime, zero, name, name, &
      name, props, two, reshape([two, two, two, two, two], [3, 3]), table, zero, zero, 1, 2, 2, &
      1, 7, 2, 1, 1, 1, 0, none, none, none, 0)
    pressure = stress(1)
    stiffness = ddsddr(1, 1)
  end subroutine press
end program stub
